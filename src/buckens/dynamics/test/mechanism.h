// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/analysis/initial/acceleration.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::test {

/// Builds models directly from bodies and joints, for tests that need no model file.
class Mechanism {
 public:
  explicit Mechanism(std::optional<spatial::Plane> planar = std::nullopt) {
    model_.planar = planar;
  }

  void set_gravity(const Eigen::Vector3d& g) { model_.gravity = g; }
  void set_length(double L) { model_.length = L; }

  /// Rigid body with its mass centre at X.
  int add_rigid(double mass, const Eigen::Matrix3d& J0, const spatial::Pose& X) {
    body::Body body;
    body.mass = mass;
    body.J0 = J0;
    return add_body(std::move(body), X);
  }

  /// Flexible body; X is the pose of its model axes.
  int add_flexible(fem::FeModel fe, const body::CouplingChoice& coupling, const spatial::Pose& X) {
    body::Body body;
    body.mass = fe.shape.mass;
    body.J0 = fe.shape.J0;
    body.com = fe.shape.com;
    body.flexible = std::make_unique<body::FlexiblePart>("flexible", std::move(fe), coupling);
    body.flexible->rows.resize(0, body.num_dofs());
    const spatial::Pose X_WB{X * body.com, X.q};
    return add_body(std::move(body), X_WB);
  }

  /// Marker on a rigid body, placed relative to the mass centre.
  model::MarkerId rigid_marker(int body, const Eigen::Vector3d& p_BF,
                               const Eigen::Quaterniond& q_BF = Eigen::Quaterniond::Identity()) {
    body::Body& b = at(body);
    b.markers.push_back({"m" + std::to_string(b.markers.size()), {p_BF, q_BF}});
    return id(body);
  }

  /// Marker on a rigid body at a place of the world, parallel to the body.
  model::MarkerId marker_at(int body, const Eigen::Vector3d& p_W) {
    return rigid_marker(body, model_.placed[static_cast<std::size_t>(body)].inverse() * p_W);
  }

  /// Marker that follows a node of a flexible body.
  model::MarkerId node_marker(int body, int node) {
    body::Body& b = at(body);
    body::FlexiblePart& part = *b.flexible;
    const auto& mesh_node = part.fe.nodes[static_cast<std::size_t>(node)];
    const auto& dofs = part.fe.dofs.node_dofs[static_cast<std::size_t>(node)];
    const int first = part.num_interface_rows;
    const bool rotates = dofs[3] >= 0 || dofs[4] >= 0 || dofs[5] >= 0;
    const int count = rotates ? 6 : 3;
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows(first + count, b.num_dofs());
    for (int r = 0; r < first; ++r) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(part.rows, r); it; ++it) {
        rows.insert(r, it.col()) = it.value();
      }
    }
    for (int k = 0; k < count; ++k) {
      const int dof = dofs[static_cast<std::size_t>(k)];
      if (dof >= 0) rows.insert(first + k, dof) = 1.0;
    }
    rows.makeCompressed();
    part.rows = rows;
    part.num_interface_rows = first + count;
    body::Marker marker;
    marker.name = "m" + std::to_string(b.markers.size());
    marker.X_BF.p = mesh_node.position - b.com;
    marker.translation_row = first;
    if (rotates) marker.rotation_row = first + 3;
    b.markers.push_back(marker);
    return id(body);
  }

  static model::MarkerId ground(const Eigen::Vector3d& p) {
    model::MarkerId out;
    out.X_WF.p = p;
    out.text = "ground";
    return out;
  }

  /// Joint between markers as they stand now.
  /// @param more sets what the joint needs beside its axis
  void add_joint(joints::JointType type, const model::MarkerId& first,
                 const model::MarkerId& second,
                 const Eigen::Vector3d& axis_F = Eigen::Vector3d::UnitZ(),
                 std::optional<base::TimeLaw> law = std::nullopt,
                 const std::function<void(joints::Placement&)>& more = nullptr) {
    model::Joint joint;
    joint.name = "j" + std::to_string(model_.joints.size());
    joint.type = type;
    joint.first = first;
    joint.second = second;
    joint.axis_F = axis_F;
    joints::Placement placement;
    placement.R_WF = world_pose(first).R();
    placement.R_WM = world_pose(second).R();
    placement.r_F = world_pose(first).inverse() * world_pose(second).p;
    placement.axis_F = axis_F;
    placement.planar = model_.planar;
    placement.law = std::move(law);
    if (more) more(placement);
    joint.rows = joints::make_rows(type, placement);
    joint.first_row = model_.num_constraint_rows();
    joint.first_state = model_.num_row_states();
    model_.joints.push_back(std::move(joint));
  }

  /// Coordinate of a joint as it stands now. @return its index, for add_coupler()
  int add_coordinate(int joint, joints::JointCoordinate::Kind kind) {
    const model::Joint& owner = model_.joints[static_cast<std::size_t>(joint)];
    const spatial::Pose F = world_pose(owner.first);
    const spatial::Pose M = world_pose(owner.second);
    model_.coordinates.push_back(
        {joint, owner.first, owner.second,
         kind == joints::JointCoordinate::Kind::angle
             ? joints::JointCoordinate::angle(owner.axis_F, F.R().transpose() * M.R())
             : joints::JointCoordinate::displacement(owner.axis_F, F.inverse() * M.p)});
    return static_cast<int>(model_.coordinates.size()) - 1;
  }

  /// Any coordinate between the markers of a joint. @return its index
  int add_coordinate(int joint, joints::JointCoordinate law) {
    const model::Joint& owner = model_.joints[static_cast<std::size_t>(joint)];
    model_.coordinates.push_back({joint, owner.first, owner.second, std::move(law)});
    return static_cast<int>(model_.coordinates.size()) - 1;
  }

  /// @param law of the sum, zero if absent
  void add_coupler(const std::vector<model::CoupledCoordinate>& coupled,
                   std::optional<base::TimeLaw> law = std::nullopt) {
    const model::Coordinate& front =
        model_.coordinates[static_cast<std::size_t>(coupled.front().coordinate)];
    model::Joint joint = model_.joints[static_cast<std::size_t>(front.joint)];
    joint.name = "j" + std::to_string(model_.joints.size());
    joint.type = joints::JointType::coupler;
    joint.rows = {joints::ConstraintRow::coupled(!front.law.is_angle(), std::move(law))};
    joint.first_row = model_.num_constraint_rows();
    joint.first_state = model_.num_row_states();
    joint.coupled = coupled;
    model_.joints.push_back(std::move(joint));
  }

  /// Slider on the nodes of a beam. @param way a law of time along it, from as placed
  void add_slider(const std::vector<model::MarkerId>& nodes, const model::MarkerId& slider,
                  std::optional<base::TimeLaw> way = std::nullopt) {
    auto track = std::make_shared<model::Track>();
    std::vector<spatial::MarkerMotion> motions;
    for (const model::MarkerId& id : nodes) {
      const spatial::Pose X = world_pose(id);
      motions.push_back({X.p, X.R(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
      if (track->bodies.empty() || track->bodies.back().body != id.body) {
        track->bodies.push_back(id);
      }
    }
    track->shape = joints::BeamTrack(motions, model_.planar);
    track->nodes = nodes;
    track->placed =
        track->shape
            .nearest(world_pose(slider).p, std::nullopt, [&](std::size_t k) { return motions[k]; })
            .s;
    model::Joint joint;
    joint.name = "j" + std::to_string(model_.joints.size());
    joint.type = joints::JointType::slider_on_beam;
    joint.first = nodes.front();
    joint.second = slider;
    joint.track = std::move(track);
    joint.rows.push_back(joints::ConstraintRow::travelling(0));
    if (!model_.planar) joint.rows.push_back(joints::ConstraintRow::travelling(1));
    if (way) joint.rows.push_back(joints::ConstraintRow::travelling(2, std::move(way)));
    joint.first_row = model_.num_constraint_rows();
    joint.first_state = model_.num_row_states();
    model_.joints.push_back(std::move(joint));
  }

  void add_load(std::unique_ptr<loads::ForceElement> element, const model::MarkerId& first,
                const model::MarkerId& second) {
    model::Load load;
    load.name = "l" + std::to_string(model_.loads.size());
    load.element = std::move(element);
    load.first = first;
    load.second = second;
    load.first_state = num_load_states();
    model_.loads.push_back(std::move(load));
  }

  /// Law on the coordinate of the joint added last.
  void add_law(std::unique_ptr<loads::ForceElement> element, joints::JointCoordinate coordinate) {
    const model::Joint& joint = model_.joints.back();
    add_load(std::move(element), joint.first, joint.second);
    model::Load& load = model_.loads.back();
    load.joint = static_cast<int>(model_.joints.size()) - 1;
    load.coordinate = static_cast<int>(model_.coordinates.size());
    if (load.element->is_rigid()) load.rigid_row = model_.num_rigid_rows();
    model_.coordinates.push_back({load.joint, joint.first, joint.second, std::move(coordinate)});
  }

  /// Law that acts on both markers of the joint added last and sees its reaction.
  void add_law_of_joint(std::unique_ptr<loads::ForceElement> element) {
    const model::Joint& joint = model_.joints.back();
    add_load(std::move(element), joint.first, joint.second);
    model_.loads.back().joint = static_cast<int>(model_.joints.size()) - 1;
  }

  /// Pose of an undeformed marker as placed.
  spatial::Pose world_pose(const model::MarkerId& marker) const {
    if (marker.body == model::kGround) return marker.X_WF;
    const auto b = static_cast<std::size_t>(marker.body);
    const auto m = static_cast<std::size_t>(marker.marker);
    return model_.placed[b] * model_.bodies[b].markers[m].X_BF;
  }

  model::Model take() { return std::move(model_); }

 private:
  int num_load_states() const {
    if (model_.loads.empty()) return 0;
    const model::Load& last = model_.loads.back();
    return last.first_state + last.element->num_states();
  }
  body::Body& at(int body) { return model_.bodies[static_cast<std::size_t>(body)]; }
  model::MarkerId id(int body) {
    model::MarkerId out;
    out.body = body;
    out.marker = static_cast<int>(at(body).markers.size()) - 1;
    out.text = at(body).name + "/" + at(body).markers.back().name;
    return out;
  }
  int add_body(body::Body body, const spatial::Pose& X_WB) {
    body.name = "b" + std::to_string(model_.bodies.size());
    std::optional<Eigen::Vector3d> normal;
    if (model_.planar) normal = spatial::normal(*model_.planar);
    body::select_frame_coordinates(body, normal);
    model_.bodies.push_back(std::move(body));
    model_.placed.push_back(X_WB);
    return static_cast<int>(model_.bodies.size()) - 1;
  }

  model::Model model_;
};

/// A model in a consistent initial state.
struct Start {
  model::State state;
  std::vector<int> rows_in_use;
};

/// Closes joints, projects the velocities set by `give_velocities`, computes accelerations.
template <class GiveVelocities>
Start consistent_start(const model::Model& model, GiveVelocities give_velocities) {
  Start start;
  const dynamics::MassMetric metric(model);
  start.state = model::placed_state(model);
  analysis::assemble_positions(model, metric, start.state);
  give_velocities(start.state);
  analysis::project_velocities(model, metric, start.state);
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, start.state), 0.0, constraints);
  start.rows_in_use = metric.split(constraints.rows).independent;
  start.state.memory = dynamics::start_memory(model, dynamics::motions_of(model, start.state));
  analysis::compute_accelerations(model, metric, start.rows_in_use, start.state);
  return start;
}

inline Start consistent_start(const model::Model& model) {
  return consistent_start(model, [](model::State&) {});
}

/// Straight Euler–Bernoulli beam along x from the origin, given by its constants per length. The
/// inertia of torsion follows: ρ I_p = ρA (EIy + EIz) / EA.
struct BeamConstants {
  double L = 1, rhoA = 1, EA = 1e6, EIy = 100, EIz = 100, GJ = 80;
  double alpha = 0, beta = 0;
  int elements = 4;
};

inline fem::FeModel straight_beam(const BeamConstants& c,
                                  std::optional<spatial::Plane> planar = std::nullopt) {
  // With unit area the constants per length are those of the material.
  fem::Material material;
  material.rho = c.rhoA;
  material.E = c.EA;
  material.G = c.EA / 2.5;
  material.damping_mass = c.alpha;
  material.damping_stiffness = c.beta;
  const fem::Section section =
      fem::Section::general(1.0, c.EIy / material.E, c.EIz / material.E, c.GJ / material.G);
  fem::Structure structure;
  fem::add_node(structure, "start", {0, 0, 0});
  fem::add_node(structure, "end", {c.L, 0, 0});
  fem::add_beam(structure, 0, 1, c.elements,
                fem::BeamProperties::of(material, section, fem::BeamTheory::euler_bernoulli));
  return fem::assemble(structure, planar);
}

}  // namespace buckens::test
