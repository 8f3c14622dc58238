// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/recorder.h"

#include <utility>

#include "buckens/dynamics/constraints.h"

namespace buckens::results {

using Eigen::Vector3d;

namespace {

GeometrySide side_of(const model::Model& model, const model::MarkerId& id) {
  GeometrySide side;
  side.body = id.body == model::kGround ? kGroundBody : id.body;
  if (id.body == model::kGround) {
    side.position = id.X_WF.p;
    return side;
  }
  side.marker = id.marker;
  side.position = model.bodies[static_cast<std::size_t>(id.body)]
                      .markers[static_cast<std::size_t>(id.marker)]
                      .X_BF.p;
  return side;
}

/// A direction given in a marker's axes, in those of its body.
Vector3d to_body(const model::Model& model, const model::MarkerId& id, const Vector3d& axis) {
  if (id.body == model::kGround) return id.X_WF.q * axis;
  return model.bodies[static_cast<std::size_t>(id.body)]
             .markers[static_cast<std::size_t>(id.marker)]
             .X_BF.q *
         axis;
}

const std::vector<std::string> kXyz = {"x", "y", "z"};

}  // namespace

Recorder::Recorder(const model::BuiltModel& built, const dynamics::MassMetric& metric,
                   bool has_redundant_joints)
    : built_(built), metric_(metric), has_redundant_joints_(has_redundant_joints) {
  for (const body::Body& body : built.model.bodies) {
    recoveries_.push_back(body.is_flexible() ? std::make_unique<fem::Recovery>(body.flexible->fe)
                                             : nullptr);
  }
  for (std::size_t k = 0; k < built.description.output.sensors.size(); ++k) {
    sensors_.push_back(make_sensor(built, k));
  }
  add_channels();
}

Recorder::~Recorder() = default;

void Recorder::add_channels() {
  for (std::size_t b = 0; b < built_.model.bodies.size(); ++b) {
    const body::Body& body = built_.model.bodies[b];
    const std::string path = "bodies/" + body.name;
    layout_.add({path + "/pose",
                 "m, 1",
                 {7},
                 "origin of the body frame and its quaternion",
                 {"x", "y", "z", "qw", "qx", "qy", "qz"}});
    layout_.add({path + "/velocity", "m/s", {3}, "of the body frame's origin, world axes", kXyz});
    layout_.add({path + "/angular_velocity", "rad/s", {3}, "of the body frame, body axes", kXyz});
    if (!body.is_flexible()) continue;
    const int nodes = static_cast<int>(body.flexible->fe.nodes.size());
    const int elements = recoveries_[b]->num_elements();
    layout_.add({path + "/displacement",
                 "m, rad",
                 {nodes, 6},
                 "nodal translations and rotations in body axes",
                 {"x", "y", "z", "rx", "ry", "rz"}});
    if (elements == 0) continue;
    layout_.add({path + "/section_force",
                 "N, N m",
                 {elements, 12},
                 "section forces at both ends of each element, element axes",
                 {"N_1", "Qy_1", "Qz_1", "Mt_1", "My_1", "Mz_1", "N_2", "Qy_2", "Qz_2", "Mt_2",
                  "My_2", "Mz_2"}});
    layout_.add({path + "/stress",
                 "Pa",
                 {elements, 2},
                 "largest axial and von Mises stress",
                 {"axial", "mises"}});
  }
  for (const model::Joint& joint : built_.model.joints) {
    layout_.add(
        {"joints/" + joint.name + "/force", "N", {3}, "on the second marker, world axes", kXyz});
    layout_.add({"joints/" + joint.name + "/torque",
                 "N m",
                 {3},
                 "on the second marker about its origin, world axes",
                 kXyz});
  }
  for (const char* name :
       {"kinetic", "strain", "gravity", "springs", "total", "work", "dissipated", "balance"}) {
    layout_.add({std::string("energies/") + name, "J", {}, "energy of the whole model", {}});
  }
  for (const auto& sensor : sensors_) {
    for (Channel& channel : sensor->channels()) layout_.add(std::move(channel));
  }
}

Geometry Recorder::geometry() const {
  const model::Model& model = built_.model;
  Geometry out;
  out.gravity = model.gravity;
  if (model.planar)
    out.planar = choice_names(*model.planar)[static_cast<std::size_t>(*model.planar)];
  for (const body::Body& body : model.bodies) {
    GeometryBody shape;
    shape.name = body.name;
    for (const body::Marker& marker : body.markers) {
      shape.markers.push_back({marker.name, marker.node, marker.X_BF});
    }
    if (body.is_flexible()) {
      shape.kind = BodyKind::beam;
      const fem::FeModel& fe = body.flexible->fe;
      shape.nodes.resize(static_cast<Eigen::Index>(fe.nodes.size()), 3);
      for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
        shape.nodes.row(static_cast<Eigen::Index>(k)) =
            (fe.nodes[k].position - body.com).transpose();
      }
      for (const fem::LineElement& line : fem::line_elements(fe)) {
        shape.elements.push_back({line.a, line.b});
        shape.radius.push_back(line.radius);
      }
    }
    out.bodies.push_back(std::move(shape));
  }
  for (const model::Joint& joint : model.joints) {
    out.joints.push_back({joint.name,
                          joints::to_string(joint.type),
                          {side_of(model, joint.first), side_of(model, joint.second)},
                          to_body(model, joint.first, joint.axis_F)});
  }
  for (const model::Load& load : model.loads) {
    if (load.element->num_soft_rows() == 0) continue;
    out.joints.push_back({load.name,
                          load.element->num_soft_rows() == 6 ? "bushing" : "spring-damper",
                          {side_of(model, load.first), side_of(model, load.second)},
                          Vector3d::UnitZ()});
  }
  return out;
}

void Recorder::append_bodies(const Observation& now, std::vector<double>& values) const {
  const auto push = [&](const Vector3d& v) { values.insert(values.end(), {v.x(), v.y(), v.z()}); };
  for (std::size_t b = 0; b < now.model.bodies.size(); ++b) {
    const model::BodyState& s = now.state.bodies[b];
    push(s.frame.X_WB.p);
    const Eigen::Quaterniond& q = s.frame.X_WB.q;
    values.insert(values.end(), {q.w(), q.x(), q.y(), q.z()});
    push(s.frame.v);
    push(s.frame.w);
    if (!recoveries_[b]) continue;
    for (const auto& dofs : now.model.bodies[b].flexible->fe.dofs.node_dofs) {
      for (const int dof : dofs) values.push_back(dof >= 0 ? s.d[dof] : 0.0);
    }
    const auto& forces = now.section_forces[b];
    values.insert(values.end(), forces.data(), forces.data() + forces.size());
    const auto& stresses = now.stresses[b];
    values.insert(values.end(), stresses.data(), stresses.data() + stresses.size());
  }
}

Record Recorder::record(const model::State& state, WorkBalance work) {
  const model::Model& model = built_.model;
  Observation now{model, state, dynamics::motions_of(model, state), {}, {}, {}, {}, work};
  linalg::Vector lambda = state.lambda;
  if (has_redundant_joints_) {
    dynamics::Constraints constraints;
    dynamics::evaluate_constraints(model, now.motions, state.t, constraints);
    lambda = dynamics::least_multipliers(model, metric_, constraints.rows, lambda);
  }
  now.joint_wrenches = joint_wrenches(model, now.motions, state.t, lambda);
  now.section_forces.resize(model.bodies.size());
  now.stresses.resize(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!recoveries_[b]) continue;
    now.section_forces[b] = recoveries_[b]->section_forces(state.bodies[b].d);
    now.stresses[b] = recoveries_[b]->stresses(now.section_forces[b]);
  }
  now.energy = dynamics::energy(model, state);
  if (!started_) first_energy_ = now.energy.total();
  now.work.balance = now.energy.total() - first_energy_ - now.work.external + now.work.dissipated;

  Record record{state.t, {}};
  record.values.reserve(layout_.num_values());
  append_bodies(now, record.values);
  for (const spatial::Wrench& wrench : now.joint_wrenches) {
    for (const Vector3d& v : {wrench.force, wrench.torque}) {
      record.values.insert(record.values.end(), {v.x(), v.y(), v.z()});
    }
  }
  const dynamics::Energy& e = now.energy;
  record.values.insert(record.values.end(),
                       {e.kinetic, e.strain, e.gravity, e.springs, e.total(), now.work.external,
                        now.work.dissipated, now.work.balance});
  for (const auto& sensor : sensors_) {
    if (!started_) sensor->start(now);
    sensor->append(now, record.values);
  }
  started_ = true;
  energy_ = e;
  balance_ = now.work.balance;
  return record;
}

}  // namespace buckens::results
