// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/error/variants.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/error/estimate.h"
#include "buckens/analysis/error/mesh_refinement.h"
#include "buckens/analysis/error/recovered_error.h"
#include "buckens/analysis/simulation/output_plan.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

namespace {

using model::ModelDescription;

// Nodal variables up to which meshes are refined, and bodies taken without reduction.
constexpr double kMostUnknowns = 100000;
// Recovered strains underestimate the error, on coarse meshes by more than half.
constexpr double kSafetyOfRecovery = 3;
constexpr double kStandardTolerance = 1e-5;
constexpr double kTolerancePart = 8;
// Elements of STEP files shorter by this factor: 3.4 times as many.
constexpr double kFinerElements = 1.5;

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "\"" : ", \"") + name + '"';
  return out;
}

class VariantList {
 public:
  VariantList(const model::BuiltModel& built, const SensorCurves& run, const Remesh& remesh)
      : model_(built.model), base_(built.description), run_(run), remesh_(remesh) {
    base_.output.every = plan_output(base_).every;
    base_.output.field_output.reset();
    // Bases of other meshes must not be stored in the file of this one.
    for (body::BodySpec& spec : base_.bodies) spec.reduction.file.clear();
    for (const body::Body& body : model_.bodies) {
      if (body.is_flexible()) unknowns_ += static_cast<double>(body.flexible->mesh().M.rows());
    }
  }

  ErrorVariants run() {
    add_time_step();
    add_mesh();
    add_meshes_of_files();
    add_frames();
    add_coupling();
    add_modes();
    return std::move(out_);
  }

 private:
  void add(const char* name, std::string what, double refinement, double factor,
           ModelDescription description) {
    out_.variants.push_back(
        {{name, std::move(what), refinement, factor, 0, 0.0}, std::move(description)});
  }

  /// Notes what no uncertainty contains, as results::unassessed() reads it.
  void leave_out(const std::string& what, const std::string& why) {
    out_.notes.push_back(what + ": " + why);
  }

  /// Why the mesh of a body can be neither refined nor judged by its strains.
  std::string why_not_refined(const std::string& name) const {
    const auto spec = std::find_if(base_.bodies.begin(), base_.bodies.end(),
                                   [&](const body::BodySpec& body) { return body.name == name; });
    if (std::holds_alternative<fem::MatricesSpec>(spec->kind)) {
      return "the body is given by matrices, which have no elements to refine";
    }
    if (std::holds_alternative<fem::StructureSpec>(spec->kind)) {
      return "its elements are listed individually and cannot be refined";
    }
    return "it comes from a file and cannot be refined, and error estimates from strains exist for "
           "solids in one frame only; compare with a finer mesh file";
  }

  void add_time_step() {
    ModelDescription finer = base_;
    model::SimulationSpec& run = *finer.simulation;
    if (run.step) *run.step *= 0.5;
    std::string what = run.step ? fmt::format("half the step, {:.4g} s", *run.step) : "";
    double refinement = 2;
    if (run.has_step_control()) {
      run.tolerance = run.tolerance.value_or(kStandardTolerance) / kTolerancePart;
      run.absolute_tolerance /= kTolerancePart;
      what = fmt::format("an eighth of the tolerance, {:.3g}", *run.tolerance);
      refinement = 0;  // the numbers of steps will tell
    }
    add(results::kTimeStepSource, what, refinement,
        refinement > 0 ? two_grid_factor(refinement) : 0.0, std::move(finer));
  }

  void add_mesh() {
    ModelDescription other = base_;
    MeshRefinement done = refine_meshes(other, MeshChange::finer);
    for (const std::string& name : done.unchanged) {
      if (!recovered(name)) leave_out(fmt::format("mesh of \"{}\"", name), why_not_refined(name));
    }
    if (!done.geometries.empty()) return add_meshes_of_parts(std::move(other), done);
    if (done.changed.empty()) return;
    if (unknowns_ * done.growth <= kMostUnknowns) {
      return add("mesh", "twice as many elements each way", 2, two_grid_factor(2),
                 std::move(other));
    }
    other = base_;
    done = refine_meshes(other, MeshChange::coarser);
    if (!done.is_possible) {
      return leave_out(
          "mesh", fmt::format("twice as many elements in each direction would be too many ({:.2g} "
                              "unknowns instead of {:.2g}), and not all divisions are even, so a "
                              "coarser mesh cannot be used for comparison either; make them even",
                              8 * unknowns_, unknowns_));
    }
    // Seen from the coarser mesh the error of this one is 1/r² of its own.
    add("mesh", "half as many elements each way", 2, two_grid_factor(2) / 4, std::move(other));
  }

  void add_meshes_of_parts(ModelDescription other, const MeshRefinement& done) {
    if (!remesh_ || unknowns_ * kFinerElements * kFinerElements * kFinerElements > kMostUnknowns) {
      return leave_out("mesh of parts of STEP files", "finer ones would be too large");
    }
    auto sizes = done.geometries;
    for (auto& part : sizes) part.second /= kFinerElements;
    const ModelDescription meshed = remesh_(sizes);
    // Generated meshes stay: all are to be finer by one factor.
    other = base_;
    for (std::size_t b = 0; b < other.bodies.size(); ++b) {
      if (std::holds_alternative<fem::GeometrySpec>(other.bodies[b].kind)) {
        other.bodies[b].kind = meshed.bodies[b].kind;
      }
    }
    if (!done.changed.empty()) {
      leave_out(fmt::format("mesh of {}", list(done.changed)),
                "not refined, since the parts of STEP files are");
    }
    add("mesh", "elements of two thirds of their size", kFinerElements,
        two_grid_factor(kFinerElements), std::move(other));
  }

  /// η² of a body at its largest deformation, see recovered_error().
  std::optional<double> recovered(const std::string& name) const {
    const linalg::Matrix deformed = run_.largest_deformation(name);
    const int w = model_.find_whole(name);
    if (deformed.size() == 0 || w < 0) return std::nullopt;
    const model::WholeBody& whole = model_.wholes[static_cast<std::size_t>(w)];
    const body::Body& body = model_.bodies[static_cast<std::size_t>(whole.first)];
    // Parts of a divided body move relative to each other without strain.
    if (whole.is_divided() || !body.is_flexible()) return std::nullopt;
    return recovered_error(body.flexible->mesh(), deformed);
  }

  bool has_shells(const std::string& name) const {
    const auto& whole = model_.wholes[static_cast<std::size_t>(model_.find_whole(name))];
    const auto& body = model_.bodies[static_cast<std::size_t>(whole.first)];
    const auto& blocks = body.flexible->mesh().blocks;
    return std::any_of(blocks.begin(), blocks.end(), [](const auto& block) {
      return block->is_shell() && block->num_elements() > 0;
    });
  }

  void add_meshes_of_files() {
    ModelDescription other = base_;
    std::string what;
    for (body::BodySpec& spec : other.bodies) {
      const std::optional<double> share = recovered(spec.name);
      if (!share || !scale_moduli(spec, 1.0 - *share)) continue;
      what += fmt::format("{}stiffness of \"{}\" lower by {:.2g} %", what.empty() ? "" : ", ",
                          spec.name, 100.0 * *share);
      if (has_shells(spec.name)) {
        leave_out(fmt::format("shells of \"{}\"", spec.name),
                  "error estimates from strains exist for solids only");
      }
    }
    if (!what.empty()) add("mesh of files", what, 0, kSafetyOfRecovery, std::move(other));
  }

  void add_frames() {
    ModelDescription other = base_;
    const std::vector<std::string> changed = refine_frames(other);
    if (changed.empty()) return;
    add("frames", "twice as many body frames", 2, two_grid_factor(2), std::move(other));
  }

  void add_coupling() {
    ModelDescription other = base_;
    bool differs = false;
    for (body::BodySpec& spec : other.bodies) {
      const bool is_less =
          spec.coupling.level != body::CouplingLevel::full || !spec.coupling.drop.empty();
      if (spec.is_rigid() || !is_less) continue;
      spec.coupling.level = body::CouplingLevel::full;
      spec.coupling.drop.clear();
      differs = true;
    }
    if (differs) add("coupling", "`coupling: full`", 0, exact_factor(), std::move(other));
  }

  void add_modes() {
    ModelDescription other = base_;
    bool is_reduced = false, is_full = unknowns_ <= kMostUnknowns;
    for (body::BodySpec& spec : other.bodies) {
      if (spec.flexibility == body::Flexibility::quasi_static) {
        leave_out(fmt::format("modes of \"{}\"", spec.name),
                  "the dynamics that a quasi-static body neglects are not assessed");
      } else if (!spec.reduction.is_none()) {
        is_reduced = true;
        improve(spec.reduction, is_full);
      }
    }
    if (!is_reduced) return;
    if (is_full) return add("modes", "full meshes", 0, exact_factor(), std::move(other));
    add("modes", "twice as many modes", 2, two_grid_factor(2), std::move(other));
  }

  static void improve(body::ReductionSpec& reduction, bool is_full) {
    if (is_full) {
      reduction = {};
    } else if (reduction.free_free) {
      reduction.free_free->modes *= 2;
    } else if (reduction.craig_bampton->modes) {
      *reduction.craig_bampton->modes = std::max(1, 2 * *reduction.craig_bampton->modes);
    } else {
      *reduction.craig_bampton->cutoff *= 2;
    }
  }

  const model::Model& model_;
  ModelDescription base_;
  const SensorCurves& run_;
  const Remesh& remesh_;
  double unknowns_ = 0;
  ErrorVariants out_;
};

}  // namespace

void require_sensors(const model::ModelDescription& description) {
  if (!description.output.sensors.empty()) return;
  throw InputError(description.where,
                   "an error statement needs sensors, and the model has none; add the quantities "
                   "of interest, such as `output: {sensors: {tip: {position: rod/end}}}`");
}

std::vector<std::string> bodies_to_watch(const ModelDescription& description) {
  std::vector<std::string> out;
  for (const body::BodySpec& spec : description.bodies) {
    const auto* mesh = std::get_if<fem::MeshSpec>(&spec.kind);
    if (mesh != nullptr && mesh->is_file()) out.push_back(spec.name);
  }
  return out;
}

ErrorVariants error_variants(const model::BuiltModel& built, const SensorCurves& run,
                             const Remesh& remesh) {
  require_sensors(built.description);
  return VariantList(built, run, remesh).run();
}

}  // namespace buckens::analysis
