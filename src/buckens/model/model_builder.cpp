// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/model_builder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/fem/assemble.h"
#include "buckens/fem/recovery.h"
#include "buckens/loads/applied_load.h"
#include "buckens/loads/bushing.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/model/marker_table.h"
#include "buckens/model/mesh_mechanism.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// sin of the angle up to which a body counts as lying in the plane of a planar model.
constexpr double kInPlane = 1e-6;

joints::Placement placement_of(const spatial::Pose& first, const spatial::Pose& second) {
  joints::Placement placement;
  placement.R_WF = first.R();
  placement.R_WM = second.R();
  placement.r_F = placement.R_WF.transpose() * (second.p - first.p);
  return placement;
}

class Builder {
 public:
  explicit Builder(ModelDescription description)
      : out_(std::make_unique<BuiltModel>()), model_(out_->model) {
    out_->description = std::move(description);
  }

  std::unique_ptr<BuiltModel> run() {
    const ModelDescription& d = out_->description;
    model_.title = d.title;
    model_.gravity = d.gravity;
    model_.planar = d.planar;
    check_gravity();
    add_bodies();
    for (const joints::JointSpec& joint : d.joints) add_joint(joint);
    for (const loads::LoadSpec& load : d.loads) add_load(load);
    close_interfaces();
    for (const SensorSpec& sensor : d.output.sensors) add_sensor(sensor);
    add_remaining_markers();
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      if (model_.bodies[b].is_flexible()) model_.bodies[b].flexible->rows = tables_[b]->rows();
    }
    model_.length = characteristic_length();
    return std::move(out_);
  }

 private:
  // ---- bodies
  void check_gravity() const {
    if (!model_.planar) return;
    if (std::abs(model_.gravity.dot(spatial::normal(*model_.planar))) > 0.0) {
      throw InputError(out_->description.where,
                       "gravity of a planar model must lie in its plane; set the component normal "
                       "to it to zero");
    }
  }

  void add_bodies() {
    const auto& specs = out_->description.bodies;
    model_.bodies.resize(specs.size());  // markers tables keep references
    meshes_.resize(specs.size());
    for (std::size_t b = 0; b < specs.size(); ++b) {
      try {
        add_body(b, specs[b]);
      } catch (const ModelError& error) {
        if (!error.where().empty()) throw;
        const std::string what = error.what();
        const bool is_named = what.find('"' + specs[b].name + '"') != std::string::npos;
        throw ModelError(specs[b].where,
                         is_named ? what : fmt::format("body \"{}\": {}", specs[b].name, what));
      }
    }
  }

  void add_body(std::size_t b, const body::BodySpec& spec) {
    body::Body& body = model_.bodies[b];
    body.name = spec.name;
    const Matrix3d R = spec.at.rotation().toRotationMatrix();
    std::optional<Vector3d> normal_B;
    if (model_.planar) {
      const Vector3d normal_W = spatial::normal(*model_.planar);
      normal_B = R.transpose() * normal_W;
      if (normal_B->cross(normal_W).norm() > kInPlane) {
        throw InputError(spec.where, fmt::format("body \"{}\" is turned out of the plane of the "
                                                 "planar model; only rotations about its normal "
                                                 "are possible",
                                                 spec.name));
      }
    }
    if (const auto* rigid = std::get_if<body::RigidSpec>(&spec.kind)) {
      body.mass = rigid->mass;
      body.com = rigid->com;
      body.J0 = rigid->inertia_matrix();
    } else {
      meshes_[b] = std::make_unique<NamedStructure>(structure_from_spec(spec));
      fem::FeModel fe = fem::assemble(meshes_[b]->structure, model_.planar);
      body.mass = fe.shape.mass;
      body.com = fe.shape.com;
      body.J0 = fe.shape.J0;
      body.flexible = std::make_unique<body::FlexiblePart>(spec.name, std::move(fe), spec.coupling);
    }
    if (!(body.mass > 0.0)) {
      throw ModelError(spec.where,
                       fmt::format("body \"{}\" has no mass; every body needs inertia, if only a "
                                   "little (merge a massless part with its neighbour)",
                                   spec.name));
    }
    body::select_frame_coordinates(body, normal_B, model_.notes);
    model_.placed.push_back(spatial::Pose{spec.at.position, spec.at.rotation()} *
                            spatial::Pose{body.com, Eigen::Quaterniond::Identity()});
    tables_.push_back(std::make_unique<MarkerTable>(spec, body, meshes_[b].get()));
  }

  // ---- markers
  MarkerId marker(const base::MarkerRef& ref, bool needs_mesh) {
    MarkerId id;
    id.text = ref.text;
    if (ref.is_ground()) {
      id.X_WF.p = ref.point.value_or(Vector3d::Zero());
      return id;
    }
    id.body = model_.find_body(ref.body);
    if (id.body == kGround) {
      std::vector<std::string> names = {"ground"};
      for (const body::Body& body : model_.bodies) names.push_back(body.name);
      const std::string near = base::nearest(ref.body, names);
      throw InputError(ref.where,
                       fmt::format("there is no body \"{}\"{}; bodies: {}", ref.body,
                                   near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near),
                                   fmt::join(names, ", ")));
    }
    id.marker = tables_[static_cast<std::size_t>(id.body)]->find(ref, needs_mesh);
    return id;
  }

  const body::Marker* on_body(const MarkerId& id) const {
    if (id.body == kGround) return nullptr;
    return &model_.bodies[static_cast<std::size_t>(id.body)]
                .markers[static_cast<std::size_t>(id.marker)];
  }

  spatial::Pose placed(const MarkerId& id) const {
    const body::Marker* marker = on_body(id);
    return marker == nullptr ? id.X_WF
                             : model_.placed[static_cast<std::size_t>(id.body)] * marker->X_BF;
  }

  void require_moment(const MarkerId& id, const std::string& what,
                      const SourceLocation& where) const {
    const body::Marker* marker = on_body(id);
    if (marker == nullptr || marker->carries_moment()) return;
    throw ModelError(where,
                     fmt::format("{}: \"{}\" cannot carry a moment, bars have no rotations "
                                 "there; use a spherical joint or a force, or make it a beam",
                                 what, id.text));
  }

  void require_two_bodies(const MarkerId& first, const MarkerId& second, const std::string& what,
                          const SourceLocation& where) const {
    if (first.body != second.body) return;
    throw ModelError(
        where,
        fmt::format("{} connects {} with itself; it needs two different bodies, or a "
                    "body and the ground",
                    what,
                    first.body == kGround
                        ? "the ground"
                        : "body \"" +
                              out_->description.bodies[static_cast<std::size_t>(first.body)].name +
                              "\""));
  }

  // ---- joints
  Vector3d axis_or_normal(const std::optional<Vector3d>& axis, const Matrix3d& R_WF,
                          const std::string& what, const SourceLocation& where) const {
    if (axis) return *axis;
    if (model_.planar) return R_WF.transpose() * spatial::normal(*model_.planar);
    throw InputError(where, what + " needs an `axis` in a model in space, for example [0, 0, 1]");
  }

  template <class Spec>
  void add_rows(joints::JointType type, const Spec& kind, const joints::JointSpec& spec) {
    const std::string what = fmt::format("joint \"{}\"", spec.name);
    Joint joint;
    joint.name = spec.name;
    joint.type = type;
    joint.first = marker(kind.between[0], true);
    joint.second = marker(kind.between[1], true);
    require_two_bodies(joint.first, joint.second, what, spec.where);
    joints::Placement placement = placement_of(placed(joint.first), placed(joint.second));
    placement.planar = model_.planar;
    if constexpr (requires { kind.axis; }) {
      placement.axis_F = axis_or_normal(kind.axis, placement.R_WF, what, spec.where);
    }
    if constexpr (requires { kind.angle; }) placement.law = kind.angle;
    if constexpr (requires { kind.displacement; }) placement.law = kind.displacement;
    try {
      joint.axis_F = joints::unit_axis(placement);
      joint.rows = joints::make_rows(type, placement);
    } catch (const ModelError& error) {
      throw ModelError(spec.where, fmt::format("{}: {}", what, error.what()));
    }
    for (const joints::ConstraintRow& row : joint.rows) {
      if (row.kind() == joints::ConstraintRow::Kind::point_world) continue;
      require_moment(joint.first, what, spec.where);
      if (row.kind() == joints::ConstraintRow::Kind::direction) {
        require_moment(joint.second, what, spec.where);
      }
    }
    joint.first_row = model_.num_constraint_rows();
    model_.joints.push_back(std::move(joint));
  }

  void add_bushing(const joints::BushingSpec& kind, const joints::JointSpec& spec) {
    const std::string what = fmt::format("joint \"{}\"", spec.name);
    Load load;
    load.name = spec.name;
    load.first = marker(kind.between[0], true);
    load.second = marker(kind.between[1], true);
    require_two_bodies(load.first, load.second, what, spec.where);
    require_moment(load.first, what, spec.where);
    require_moment(load.second, what, spec.where);
    const joints::Placement p = placement_of(placed(load.first), placed(load.second));
    load.element = std::make_unique<loads::Bushing>(
        loads::Bushing::Coefficients{kind.stiffness, kind.rotational_stiffness, kind.damping,
                                     kind.rotational_damping},
        p.R_WF.transpose() * p.R_WM, p.r_F);
    model_.loads.push_back(std::move(load));
  }

  void add_joint(const joints::JointSpec& spec) {
    using joints::JointType;
    struct Adder {
      Builder& b;
      const joints::JointSpec& spec;
      void operator()(const joints::RevoluteSpec& k) { b.add_rows(JointType::revolute, k, spec); }
      void operator()(const joints::SphericalSpec& k) { b.add_rows(JointType::spherical, k, spec); }
      void operator()(const joints::PrismaticSpec& k) { b.add_rows(JointType::prismatic, k, spec); }
      void operator()(const joints::FixedSpec& k) { b.add_rows(JointType::fixed, k, spec); }
      void operator()(const joints::BushingSpec& k) { b.add_bushing(k, spec); }
      void operator()(const joints::PrescribedRotationSpec& k) {
        b.add_rows(JointType::prescribed_rotation, k, spec);
      }
      void operator()(const joints::PrescribedTranslationSpec& k) {
        b.add_rows(JointType::prescribed_translation, k, spec);
      }
    };
    std::visit(Adder{*this, spec}, spec.kind);
  }

  // ---- loads
  template <class Spec>
  void add_applied(const Spec& kind, loads::AppliedLoad::Kind what, Load& load,
                   const SourceLocation& where) {
    load.first = marker(kind.on, true);
    if (load.first.body == kGround) {
      throw ModelError(where, fmt::format("load \"{}\" acts on the ground, which does not move; "
                                          "apply it to a body",
                                          load.name));
    }
    const bool moment = what == loads::AppliedLoad::Kind::torque;
    if (moment || kind.axes == loads::LoadAxes::following) {
      require_moment(load.first, fmt::format("load \"{}\"", load.name), where);
    }
    load.element = std::make_unique<loads::AppliedLoad>(what,
                                                        kind.axes == loads::LoadAxes::following
                                                            ? loads::AppliedLoad::Axes::following
                                                            : loads::AppliedLoad::Axes::fixed,
                                                        kind.value);
  }

  void add_spring(const loads::SpringDamperSpec& kind, Load& load, const SourceLocation& where) {
    load.first = marker(kind.between[0], true);
    load.second = marker(kind.between[1], true);
    require_two_bodies(load.first, load.second, fmt::format("load \"{}\"", load.name), where);
    const double distance = (placed(load.second).p - placed(load.first).p).norm();
    load.element = std::make_unique<loads::SpringDamper>(
        kind.stiffness, kind.damping, kind.length.value_or(distance), kind.force);
  }

  void add_torsional(const loads::TorsionalSpringSpec& kind, Load& load,
                     const SourceLocation& where) {
    const std::string what = fmt::format("load \"{}\"", load.name);
    load.first = marker(kind.between[0], true);
    load.second = marker(kind.between[1], true);
    require_two_bodies(load.first, load.second, what, where);
    require_moment(load.first, what, where);
    require_moment(load.second, what, where);
    joints::Placement p = placement_of(placed(load.first), placed(load.second));
    p.axis_F = axis_or_normal(kind.axis, p.R_WF, what, where);
    load.element =
        std::make_unique<loads::TorsionalSpring>(joints::unit_axis(p), p.R_WF.transpose() * p.R_WM,
                                                 kind.stiffness, kind.damping, kind.angle);
  }

  void add_load(const loads::LoadSpec& spec) {
    Load load;
    load.name = spec.name;
    if (const auto* force = std::get_if<loads::ForceSpec>(&spec.kind)) {
      add_applied(*force, loads::AppliedLoad::Kind::force, load, spec.where);
    } else if (const auto* torque = std::get_if<loads::TorqueSpec>(&spec.kind)) {
      add_applied(*torque, loads::AppliedLoad::Kind::torque, load, spec.where);
    } else if (const auto* spring = std::get_if<loads::SpringDamperSpec>(&spec.kind)) {
      add_spring(*spring, load, spec.where);
    } else {
      add_torsional(std::get<loads::TorsionalSpringSpec>(spec.kind), load, spec.where);
    }
    model_.loads.push_back(std::move(load));
  }

  void close_interfaces() {
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      if (model_.bodies[b].is_flexible()) {
        model_.bodies[b].flexible->num_interface_rows = tables_[b]->num_rows();
      }
    }
  }

  // ---- sensors and drawing
  void add_sensor(const SensorSpec& spec) {
    SensorPlace found;
    const auto look = [&](const base::MarkerRef& ref) {
      found.markers.push_back(marker(ref, false));
    };
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.element; }) {
            find_section(kind, found);
            return;
          }
          if constexpr (requires { kind.between; }) {
            look(kind.between[0]);
            look(kind.between[1]);
          }
          if constexpr (requires { kind.of; }) look(kind.of);
          if constexpr (requires { kind.in; }) {
            if (kind.in) look(*kind.in);
          }
          if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, DeflectionSensor>) {
            if (kind.from == DeflectionBase::chord && !kind.of.is_ground()) {
              base::MarkerRef end = kind.of;
              for (const char* name : {"start", "end"}) {
                end.marker = name;
                look(end);
              }
            }
          }
        },
        spec.kind);
    out_->sensors.push_back(std::move(found));
  }

  void find_section(const SectionPlace& kind, SensorPlace& found) {
    found.body = marker(kind.of, false).body;
    if (found.body == kGround || !model_.bodies[static_cast<std::size_t>(found.body)].flexible) {
      throw ModelError(kind.of.where,
                       fmt::format("\"{}\" is not on a flexible body; section forces "
                                   "and stresses exist on beams and bars only",
                                   kind.of.text));
    }
    const auto b = static_cast<std::size_t>(found.body);
    const auto lines = fem::line_elements(model_.bodies[b].flexible->fe);
    if (kind.element) {
      found.element = *kind.element - 1;
      if (found.element >= static_cast<int>(lines.size())) {
        throw InputError(kind.of.where, fmt::format("body \"{}\" has {} elements, not {}",
                                                    kind.of.body, lines.size(), *kind.element));
      }
      return;
    }
    const auto place = tables_[b]->place(kind.of);
    if (!place) return;
    if (place->node < 0) found.element = place->element;
    for (std::size_t e = 0; e < lines.size() && found.element < 0; ++e) {
      if (lines[e].a != place->node && lines[e].b != place->node) continue;
      found.element = static_cast<int>(e);
      found.end = lines[e].a == place->node ? 0 : 1;
    }
  }

  void add_remaining_markers() {
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      base::MarkerRef ref;
      ref.body = model_.bodies[b].name;
      for (const body::MarkerSpec& marker : out_->description.bodies[b].markers) {
        ref.marker = marker.name;
        ref.where = marker.where;
        tables_[b]->find(ref, false);
      }
    }
  }

  double characteristic_length() const {
    Eigen::AlignedBox3d box;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const body::Body& body = model_.bodies[b];
      box.extend(model_.placed[b].p);
      for (const body::Marker& marker : body.markers) {
        box.extend((model_.placed[b] * marker.X_BF).p);
      }
      if (!body.is_flexible()) continue;
      for (const auto& node : body.flexible->fe.nodes) {
        box.extend(model_.placed[b] * Vector3d(node.position - body.com));
      }
    }
    const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
    return size > 0.0 ? size : 1.0;
  }

  std::unique_ptr<BuiltModel> out_;
  Model& model_;
  std::vector<std::unique_ptr<NamedStructure>> meshes_;
  std::vector<std::unique_ptr<MarkerTable>> tables_;
};

}  // namespace

std::unique_ptr<BuiltModel> build_model(ModelDescription description) {
  return Builder(std::move(description)).run();
}

}  // namespace buckens::model
