// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/shell_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/model/state.h"
#include "buckens/results/model_geometry.h"

namespace buckens::results {

using Eigen::Vector3d;
using model::FieldQuantity;

namespace {

constexpr double kNoShellValue = std::numeric_limits<double>::quiet_NaN();

int num_volume_elements(const fem::FeModel& mesh) {
  int count = 0;
  for (const auto& block : mesh.blocks) {
    if (block->is_solid()) count += block->num_elements();
  }
  return count;
}

double plane_mises(const Vector3d& s) {
  return std::sqrt(std::max(0.0, s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3.0 * s[2] * s[2]));
}

}  // namespace

ShellFields::ShellFields(const model::Model& model, const model::FieldPlaces& places,
                         const model::FieldOutputSpec& spec)
    : model_(model), whole_(places.whole) {
  const model::WholeBody& whole = model.wholes[static_cast<std::size_t>(whole_)];
  const fem::FeModel& mesh = *mesh_of(model, whole);
  const int first_shell = num_volume_elements(mesh);
  const int end = fem::num_solids(mesh);
  for (int e = first_shell; e < end; ++e) shells_.push_back(e);
  if (shells_.empty()) return;
  const auto is_wanted = [&spec](FieldQuantity quantity) {
    return std::find(spec.record.begin(), spec.record.end(), quantity) != spec.record.end();
  };
  if (is_wanted(FieldQuantity::von_mises)) quantities_.push_back(Quantity::von_mises);
  if (is_wanted(FieldQuantity::stress)) {
    quantities_.push_back(Quantity::stress);
    quantities_.push_back(Quantity::section_force);
  }
  if (quantities_.empty()) return;
  has_extremes_ = spec.extremes != model::ExtremeRate::off;
  for (int b = whole.first; b < whole.first + whole.count; ++b) {
    Part part;
    part.body = b;
    const fem::FeModel& own = model.bodies[static_cast<std::size_t>(b)].flexible->mesh();
    part.recovery = std::make_unique<fem::ShellRecovery>(own);
    const int own_first = num_volume_elements(own);
    for (std::size_t row = 0; row < shells_.size(); ++row) {
      model::MeshCopy copy{b, shells_[row]};
      if (whole.is_divided()) copy = whole.solids[static_cast<std::size_t>(shells_[row])];
      if (copy.body != b) continue;
      part.shells.push_back(copy.index - own_first);
      part.rows.push_back(row);
      most_layers_ =
          std::max(most_layers_, part.recovery->section(part.shells.back()).layers.size());
    }
    parts_.push_back(std::move(part));
  }
}

void ShellFields::add_channels(FieldLayout& layout) const {
  const std::string body = "bodies/" + model_.wholes[static_cast<std::size_t>(whole_)].name;
  const int count = static_cast<int>(shells_.size());
  const std::string group = "fields/" + body + "/shells/";
  for (const Quantity quantity : quantities_) {
    if (quantity == Quantity::von_mises) {
      layout.fields.add({group + "von_mises",
                         "Pa",
                         {count},
                         "equivalent stress, the larger one of both sides",
                         {}});
    } else if (quantity == Quantity::stress) {
      layout.fields.add({group + "stress",
                         "Pa",
                         {count, 2 * static_cast<int>(most_layers_), 3},
                         "bottom and top of each layer, axes of the shell",
                         {"x", "y", "xy"}});
    } else {
      layout.fields.add({group + "section_force",
                         "N/m, N",
                         {count, 8},
                         "forces and moments per length, axes of the shell",
                         {"Nx", "Ny", "Nxy", "Mx", "My", "Mxy", "Qx", "Qy"}});
    }
  }
  if (!has_extremes_) return;
  const std::string path = "extremes/" + body + "/shells/von_mises";
  layout.extremes.add({path, "Pa", {count}, "largest over the run so far", {}});
  layout.extremes.add({path + "_time", "s", {count}, "when it was largest", {}});
}

void ShellFields::evaluate(const model::State& state) {
  for (Part& part : parts_) {
    const auto b = static_cast<std::size_t>(part.body);
    part.strains = part.recovery->strains(model_.bodies[b].flexible->nodal(state.bodies[b].d));
  }
}

/// Calls with every recorded shell in the order of the parts: part, shell of the part, row.
template <class Visitor>
void ShellFields::visit(Visitor&& visitor) const {
  for (const Part& part : parts_) {
    for (std::size_t k = 0; k < part.shells.size(); ++k) {
      visitor(part, part.shells[k], part.rows[k]);
    }
  }
}

double ShellFields::mises(const Part& part, int shell) const {
  const int top = static_cast<int>(part.recovery->section(shell).layers.size()) - 1;
  return std::max(plane_mises(part.recovery->stress(part.strains, shell, {0, 0.0})),
                  plane_mises(part.recovery->stress(part.strains, shell, {top, 1.0})));
}

void ShellFields::append(std::vector<double>& values) const {
  for (const Quantity quantity : quantities_) {
    const std::size_t width = quantity == Quantity::von_mises ? 1
                              : quantity == Quantity::stress  ? 6 * most_layers_
                                                              : 8;
    const std::size_t first = values.size();
    values.resize(first + width * shells_.size(), kNoShellValue);
    const auto put = [&](std::size_t row, std::size_t at, double value) {
      values[first + width * row + at] = value;
    };
    linalg::Matrix resultants;
    const Part* of = nullptr;
    visit([&](const Part& part, int shell, std::size_t row) {
      if (quantity == Quantity::von_mises) {
        put(row, 0, mises(part, shell));
      } else if (quantity == Quantity::stress) {
        const int layers = static_cast<int>(part.recovery->section(shell).layers.size());
        for (int level = 0; level < 2 * layers; ++level) {
          const fem::ShellLevel place{level / 2, level % 2 == 0 ? 0.0 : 1.0};
          const Vector3d s = part.recovery->stress(part.strains, shell, place);
          for (int k = 0; k < 3; ++k) put(row, static_cast<std::size_t>(3 * level + k), s[k]);
        }
      } else {
        if (of != &part) resultants = part.recovery->resultants(part.strains);
        of = &part;
        for (int k = 0; k < 8; ++k) put(row, static_cast<std::size_t>(k), resultants(k, shell));
      }
    });
  }
}

void ShellFields::update_extremes(double t) {
  if (!has_extremes_) return;
  const bool is_first = largest_.empty();
  largest_.resize(shells_.size(), kNoShellValue);
  times_.resize(shells_.size(), kNoShellValue);
  visit([&](const Part& part, int shell, std::size_t row) {
    const double now = mises(part, shell);
    if (!is_first && !(now > largest_[row])) return;
    largest_[row] = now;
    times_[row] = t;
  });
}

void ShellFields::append_extremes(std::vector<double>& values) const {
  if (!has_extremes_) return;
  values.insert(values.end(), largest_.begin(), largest_.end());
  values.insert(values.end(), times_.begin(), times_.end());
}

void ShellFields::visit_saved(const base::SaveVisit& visit) {
  visit.list_or_none("largest", largest_, shells_.size());
  visit.list_or_none("times", times_, largest_.size());
}

}  // namespace buckens::results
