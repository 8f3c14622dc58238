// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/build_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/timed_phase.h"
#include "buckens/base/usable_memory.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/model/build/add_coupler.h"
#include "buckens/model/build/add_distributed_load.h"
#include "buckens/model/build/add_drives.h"
#include "buckens/model/build/add_gear_teeth.h"
#include "buckens/model/build/add_joint.h"
#include "buckens/model/build/add_joint_law.h"
#include "buckens/model/build/add_load.h"
#include "buckens/model/build/add_signals.h"
#include "buckens/model/build/add_ties.h"
#include "buckens/model/build/cross_shafts.h"
#include "buckens/model/build/eliminate_links.h"
#include "buckens/model/build/find_section.h"
#include "buckens/model/build/held_damping.h"
#include "buckens/model/build/marker_finder.h"
#include "buckens/model/build/massless_rotations.h"
#include "buckens/model/build/mesh_division.h"
#include "buckens/model/build/mesh_mechanism.h"
#include "buckens/model/build/read_within_steps.h"
#include "buckens/model/build/reduce_bodies.h"
#include "buckens/model/check/check_description.h"
#include "buckens/model/check/event_parameters.h"
#include "buckens/model/check/flat_mesh.h"
#include "buckens/model/contact_group.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// sin of the angle up to which a body counts as lying in the plane of a planar model.
constexpr double kInPlane = 1e-6;
// Of the mechanism's length: farther from the origin positions would lose more than three digits.
constexpr double kFarAway = 1000.0;
// Of a beam's length: the way beyond its ends that counts as rounding.
constexpr double kRoundingOfBeam = 1e-9;

class Builder {
 public:
  Builder(ModelDescription description, body::BasisStore* bases)
      : out_(std::make_unique<BuiltModel>()), model_(out_->model), bases_(bases) {
    out_->description = std::move(description);
  }

  std::unique_ptr<BuiltModel> run() {
    const ModelDescription& d = out_->description;
    model_.title = d.title;
    model_.gravity = d.gravity;
    model_.planar = d.planar;
    add_bodies();
    MarkerFinder find(model_, tables_);
    for (std::size_t w = 0; w < divisions_.size(); ++w) {
      if (divisions_[w]) add_ties(model_.wholes[w], *divisions_[w], find);
    }
    for (const joints::JointSpec& joint : d.joints) {
      if (!is_coupler(joint)) add_joint(joint, find);
    }
    for (const joints::JointSpec& joint : d.joints) {
      if (is_coupler(joint)) add_joint(joint, find);
    }
    add_signals(d, find);
    find_gravity_settings(d);
    add_drives(d, model_);
    for (const loads::LoadSpec& load : d.loads) {
      if (!DistributedLoads::takes(load) && !is_joint_law(load)) add_load(load, find);
    }
    for (const OwnForce& force : d.own_forces) add_own_force(force, find);
    add_distributed_loads();
    for (const SensorSpec& sensor : d.output.sensors) add_sensor(sensor, find);
    for (const InitialJointSpec& start : d.initial.joints) add_starts(start, find);
    if (d.output.field_output) {
      out_->fields = find_field_places(*d.output.field_output, model_, meshes_);
    }
    add_remaining_markers(find);
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      if (model_.bodies[b].is_flexible()) model_.bodies[b].flexible->rows = tables_[b]->rows();
    }
    const Eigen::AlignedBox3d box = extent();
    const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
    model_.length = size > 0.0 ? size : 1.0;
    for (const loads::LoadSpec& load : d.loads) {
      if (is_joint_law(load)) add_joint_law(load, find, model_.length);
    }
    for (const EventSpec& event : d.events) {
      for (const std::string& joint : event.lock) {
        add_lock(*base::find_named(d.joints, joint), find);
      }
    }
    require_common_carriers(model_);
    require_bent_shafts(find);
    read_within_steps(*out_);
    connect_signals(d, model_);
    settle_drives(d, model_);
    number_states();
    if (size > 0.0) move_origin(box.center());
    settle_massless_rotations(model_, d.simulation ? d.simulation->duration : 0.0);
    reduce_bodies(out_->description, model_, bases_);
    hold_damping(model_);
    // C contains it.
    for (body::Body& body : model_.bodies) {
      if (body.is_flexible()) body.flexible->fe.K_damping = linalg::SymmetricMatrix();
    }
    return std::move(out_);
  }

 private:
  void find_gravity_settings(const ModelDescription& d) {
    for (std::size_t k = 0; k < d.signals.size(); ++k) {
      if (d.signals[k].name == kGravitySettings[0]) model_.gravity_settings = static_cast<int>(k);
    }
  }

  // ---- bodies
  void add_bodies() {
    const auto& specs = out_->description.bodies;
    meshes_.resize(specs.size());
    divisions_.resize(specs.size());
    int count = 0;
    for (std::size_t w = 0; w < specs.size(); ++w) {
      citing(specs[w], [&] { plan_body(w, specs[w]); });
      model_.wholes[w].first = count;
      count += model_.wholes[w].count;
    }
    model_.bodies.resize(static_cast<std::size_t>(count));  // marker tables keep references
    for (std::size_t w = 0; w < specs.size(); ++w) {
      citing(specs[w], [&] { add_body(w, specs[w]); });
    }
  }

  /// Puts place and name before what is wrong with a body.
  template <class Work>
  static void citing(const body::BodySpec& spec, Work&& work) {
    try {
      work();
    } catch (const ModelError& error) {
      if (!error.where().empty()) throw;
      const std::string what = error.what();
      const bool is_named = what.find('"' + spec.name + '"') != std::string::npos ||
                            what.find('"' + spec.name + '[') != std::string::npos;
      throw ModelError(spec.where,
                       is_named ? what : fmt::format("body \"{}\": {}", spec.name, what));
    }
  }

  /// Makes the mesh of a body and divides it among its frames.
  void plan_body(std::size_t w, const body::BodySpec& spec) {
    WholeBody& whole = model_.wholes.emplace_back();
    whole.name = spec.name;
    whole.where = spec.where;
    if (spec.geometric_stiffness) note_stiffening(spec);
    if (std::holds_alternative<body::RigidSpec>(spec.kind)) return;
    const base::TimedPhase phase("meshes");
    meshes_[w] = std::make_unique<NamedStructure>(structure_from_spec(spec));
    // Loads on offset shells find the directors that their inertia has.
    meshes_[w]->structure.shells.choose_directors(meshes_[w]->structure.nodes);
    for (const std::string& note : meshes_[w]->notes) {
      model_.notes.push_back(fmt::format("body \"{}\": {}", spec.name, note));
    }
    whole.interfaces = meshes_[w]->interfaces;
    if (spec.frames.is_one()) return;
    // The whole mesh comes first: it finds what is wrong with nodes and elements.
    auto mesh = std::make_shared<fem::FeModel>(assemble(*meshes_[w], model_.planar));
    MeshDivision division = divide_mesh(*meshes_[w], spec.frames);
    if (division.parts.size() == 1) return;
    require_memory(division, base::usable_memory());
    whole.count = static_cast<int>(division.parts.size());
    whole.mesh = std::move(mesh);
    divisions_[w] = std::make_unique<MeshDivision>(std::move(division));
  }

  void note_stiffening(const body::BodySpec& spec) {
    if (spec.coupling.choice().is_automatic) {
      throw InputError(spec.where, fmt::format("body \"{}\": geometric stiffness needs a fixed "
                                               "coupling level; write `coupling: full`",
                                               spec.name));
    }
    model_.notes.push_back(fmt::format(
        "body \"{}\": geometric stiffness conserves neither energy nor angular momentum, and "
        "static analyses leave it out",
        spec.name));
  }

  void add_body(std::size_t w, const body::BodySpec& spec) {
    WholeBody& whole = model_.wholes[w];
    if (!divisions_[w]) {
      model_.bodies[static_cast<std::size_t>(whole.first)].name = spec.name;
      add_part(whole, whole.first, spec, meshes_[w].get());
      whole.mass = model_.bodies[static_cast<std::size_t>(whole.first)].mass;
      whole.com = model_.bodies[static_cast<std::size_t>(whole.first)].com;
      return;
    }
    whole.mass = whole.mesh->shape.mass;
    whole.com = whole.mesh->shape.com;
    const std::size_t notes = model_.notes.size();
    for (int k = 0; k < whole.count; ++k) {
      const int b = whole.first + k;
      model_.bodies[static_cast<std::size_t>(b)].name = fmt::format("{}[{}]", spec.name, k + 1);
      add_part(whole, b, spec, &divisions_[w]->parts[static_cast<std::size_t>(k)]);
    }
    if (model_.notes.size() > notes + 1) {
      model_.notes[notes] += fmt::format("; {} more notes of this kind on parts of \"{}\"",
                                         model_.notes.size() - notes - 1, spec.name);
      model_.notes.resize(notes + 1);
    }
    for (const auto& copies : divisions_[w]->nodes) {
      whole.nodes.push_back({whole.first + copies.front().part, copies.front().index});
    }
    for (const auto& line : divisions_[w]->lines) {
      whole.lines.push_back({whole.first + line.part, line.index});
    }
    for (const auto& solid : divisions_[w]->solids) {
      whole.solids.push_back({whole.first + solid.part, solid.index});
    }
  }

  /// @throws InputError if it iterates and this installation cannot
  static body::SolverChoice solver_of(const body::BodySpec& spec) {
    body::SolverChoice choice = spec.solver.choice();
    if (choice.kind != body::SolverKind::iterative) return choice;
    const std::string missing = linalg::missing_grid_solver();
    if (missing.empty()) return choice;
    throw InputError(spec.where,
                     fmt::format("body \"{}\": `solver: iterative` needs the multigrid solver of "
                                 "PETSc: {}; or leave `solver` out",
                                 spec.name, missing));
  }

  /// Adds one body of the model: a rigid one, a mesh, or a part of a mesh.
  void add_part(const WholeBody& whole, int index, const body::BodySpec& spec,
                const NamedStructure* mesh) {
    body::Body& body = model_.bodies[static_cast<std::size_t>(index)];
    const Matrix3d R = spec.at.rotation().toRotationMatrix();
    std::optional<Vector3d> normal_B;
    if (model_.planar) {
      const Vector3d normal_W = spatial::normal(*model_.planar);
      normal_B = R.transpose() * normal_W;
      if (normal_B->cross(normal_W).norm() > kInPlane) {
        throw InputError(spec.where,
                         fmt::format("body \"{}\" is rotated out of the plane of the planar model; "
                                     "only rotations about its normal are possible",
                                     spec.name));
      }
    }
    if (const auto* rigid = std::get_if<body::RigidSpec>(&spec.kind)) {
      body.mass = rigid->mass;
      body.com = rigid->com;
      body.J0 = rigid->inertia_matrix();
    } else {
      if (normal_B) require_flat(spec.name, spec.where, mesh->structure, *normal_B);
      fem::FeModel fe = assemble(*mesh, model_.planar);
      body.mass = fe.shape.mass;
      body.com = fe.shape.com;
      body.J0 = fe.shape.J0;
      body.flexible =
          std::make_unique<body::FlexiblePart>(body.name, std::move(fe), spec.coupling.choice());
      const bool has_links = !mesh->structure.links.empty();
      if (!has_links) refuse_mechanisms(body);
      if (spec.geometric_stiffness) body.flexible->stiffen();
      eliminate_links(*mesh, body, model_.notes);
      if (has_links) refuse_mechanisms(body);
      body.flexible->solver = solver_of(spec);
    }
    if (!(body.mass > 0.0)) {
      throw ModelError(spec.where,
                       fmt::format("body \"{}\" has no mass; every body needs inertia, however "
                                   "little (merge a massless part with its neighbour)",
                                   body.name));
    }
    body::select_frame_coordinates(body, normal_B);
    model_.placed.push_back(spatial::Pose{spec.at.position, spec.at.rotation()} *
                            spatial::Pose{body.com, Eigen::Quaterniond::Identity()});
    tables_.push_back(std::make_unique<MarkerTable>(
        spec, body, mesh, whole.is_divided() ? std::optional(whole.com) : std::nullopt));
  }

  /// Adds their rows behind those of joints and markers, and ends the interface.
  void add_distributed_loads() {
    std::vector<int> held;
    for (const auto& table : tables_) held.push_back(table->num_rows());
    const ModelDescription& d = out_->description;
    DistributedLoads loads(model_, d, meshes_, divisions_, tables_);
    for (const loads::LoadSpec& load : d.loads) loads.add(load);
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      if (!model_.bodies[b].is_flexible()) continue;
      body::FlexiblePart& part = *model_.bodies[b].flexible;
      part.num_interface_rows = tables_[b]->num_rows();
      part.num_pattern_rows = part.num_interface_rows - held[b];
    }
  }

  /// Places of the states of joints, and of the states and rigid rows of force laws, one after the
  /// other.
  void number_states() {
    int next = 0;
    for (Joint& joint : model_.joints) {
      joint.first_state = next;
      for (const joints::ConstraintRow& row : joint.rows) next += row.num_states();
    }
    next = 0;
    int rigid_rows = 0;
    for (Load& load : model_.loads) {
      load.first_state = next;
      next += load.element->num_states();
      if (load.element->is_rigid()) load.rigid_row = rigid_rows++;
    }
  }

  /// @throws InputError for a slider that would start beside its beam
  static void require_on_beam(const Track& track, const InitialJointSpec& spec, double value) {
    const double length = track.shape.length();
    const double rounding = kRoundingOfBeam * length;
    const double s = track.placed + value;
    if (s >= -rounding && s <= length + rounding) return;
    throw InputError(
        spec.where,
        fmt::format(
            "initial: joint \"{}\" would start {:.6g} m beyond the {} of its beam of {:.6g} "
            "m, on which it is placed {:.6g} m from the start; give a displacement from "
            "{:.6g} to {:.6g} m",
            spec.name, s < 0.0 ? -s : s - length, s < 0.0 ? "start" : "end", length, track.placed,
            -track.placed, length - track.placed));
  }

  void add_starts(const InitialJointSpec& spec, MarkerFinder& find) {
    for (const base::CoordinateName& name : base::kCoordinateNames) {
      if (spec.key_of(name) == nullptr) continue;
      const int coordinate =
          find_coordinate(spec.name, name.which, base::CoordinateSort::any, find);
      if (coordinate < 0) {
        throw InputError(spec.where, fmt::format("initial: there is no joint \"{}\"", spec.name));
      }
      const auto owner =
          static_cast<std::size_t>(model_.coordinates[static_cast<std::size_t>(coordinate)].joint);
      const auto k = static_cast<std::size_t>(name.which);
      if (model_.joints[owner].track && spec.values[k]) {
        require_on_beam(*model_.joints[owner].track, spec, *spec.values[k]);
      }
      out_->starts.push_back({coordinate, spec.values[k], spec.rates[k], spec.where});
    }
  }

  // ---- sensors and drawing
  void add_sensor(const SensorSpec& spec, MarkerFinder& find) {
    SensorPlace found;
    if (const auto* seen = std::get_if<JointCoordinateSensor>(&spec.kind)) {
      found.coordinate = find_coordinate(seen->joint, seen->which, base::CoordinateSort::any, find);
    }
    const auto look = [&](const base::MarkerRef& ref) {
      found.markers.push_back(find.marker(ref, false));
    };
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.element; }) {
            find_section(kind, std::is_same_v<std::decay_t<decltype(kind)>, SectionForceSensor>,
                         find, found);
            return;
          }
          if constexpr (requires { kind.between; }) {
            look(kind.between[0]);
            look(kind.between[1]);
          }
          if constexpr (requires { kind.of; }) look(kind.of);
          if constexpr (requires { kind.about; }) {
            found.markers.push_back(kind.about ? find.marker(*kind.about, false) : MarkerId{});
          }
          if constexpr (requires { kind.in; }) {
            if (kind.in) look(*kind.in);
          }
          if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, DeflectionSensor>) {
            if (kind.from == DeflectionBase::other) look(kind.from.marker);
            if (kind.from == DeflectionBase::chord && !kind.of.is_ground()) {
              for (const base::MarkerRef& end : kind.chord_ends()) look(end);
            }
          }
        },
        spec.kind);
    out_->sensors.push_back(std::move(found));
  }

  void add_remaining_markers(MarkerFinder& find) {
    for (const body::BodySpec& spec : out_->description.bodies) {
      base::MarkerRef ref;
      ref.body = spec.name;
      const auto find_all = [&](const auto& named) {
        for (const auto& entry : named) {
          ref.marker = entry.name;
          ref.where = entry.where;
          find.marker(ref, false);
        }
      };
      find_all(spec.markers);
      find_all(spec.interfaces);
    }
  }

  Eigen::AlignedBox3d extent() const {
    Eigen::AlignedBox3d box;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const body::Body& body = model_.bodies[b];
      box.extend(model_.placed[b].p);
      for (const body::Marker& marker : body.markers) {
        box.extend((model_.placed[b] * marker.X_BF).p);
      }
      if (!body.is_flexible()) continue;
      for (const auto& node : body.flexible->mesh().nodes) {
        box.extend(model_.placed[b] * Vector3d(node.position - body.com));
      }
    }
    return box;
  }

  /// Makes positions relative to an origin near the mechanism if it is far away: they keep all
  /// digits of the model file, and nothing depends on the location.
  void move_origin(const Vector3d& centre) {
    if (centre.norm() <= kFarAway * model_.length) return;
    // Few digits, so that differences to what the model file says are exact.
    const double unit = std::exp2(std::ceil(std::log2(model_.length)));
    model_.origin = unit * (centre / unit).array().round().matrix();
    for (spatial::Pose& X : model_.placed) X.p -= model_.origin;
    const auto move = [this](MarkerId& id) {
      if (id.body == kGround) id.X_WF.p -= model_.origin;
    };
    for (Joint& joint : model_.joints) {
      move(joint.first);
      move(joint.second);
    }
    for (Load& load : model_.loads) {
      move(load.first);
      move(load.second);
      for (MarkerId& id : load.others) move(id);
    }
    for (auto& group : model_.contact_groups) {
      auto moved = std::make_shared<ContactGroup>(*group);
      for (ContactMember& member : moved->members) move(member.marker);
      group = std::move(moved);
    }
    for (Signal& signal : model_.signals.all) {
      move(signal.marker);
      if (!signal.reading) continue;
      move(signal.reading->first);
      move(signal.reading->second);
    }
    for (SensorPlace& place : out_->sensors) {
      for (MarkerId& id : place.markers) move(id);
    }
  }

  std::unique_ptr<BuiltModel> out_;
  Model& model_;
  body::BasisStore* bases_;
  std::vector<std::unique_ptr<NamedStructure>> meshes_;   // one per whole body
  std::vector<std::unique_ptr<MeshDivision>> divisions_;  // empty unless divided
  std::vector<std::unique_ptr<MarkerTable>> tables_;
};

}  // namespace

std::unique_ptr<BuiltModel> build_model(ModelDescription description, body::BasisStore* bases) {
  std::unique_ptr<BuiltModel> out;
  {
    const base::TimedPhase phase("model");
    require_sound(description);
    make_settings_of_parameters(description);
    out = Builder(std::move(description), bases).run();
  }
  out->phases = base::take_phases();
  return out;
}

}  // namespace buckens::model
