// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "buckens/analysis/initial/acceleration.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/analysis/statics/equilibrium.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis::test {

using Eigen::Vector3d;

/// "ground", "rod" or "rod/end".
inline base::MarkerRef at_marker(const std::string& text) {
  base::MarkerRef out;
  const auto slash = text.find('/');
  out.body = text.substr(0, slash);
  if (slash != std::string::npos) out.marker = text.substr(slash + 1);
  out.text = text;
  return out;
}

inline base::MarkerRef ground_at(const Vector3d& point) {
  base::MarkerRef out = at_marker("ground");
  out.point = point;
  return out;
}

inline std::array<base::TimeLaw, 3> constant_law(const Vector3d& value) {
  return {base::TimeLaw::constant(value.x()), base::TimeLaw::constant(value.y()),
          base::TimeLaw::constant(value.z())};
}

/// A small mechanism under construction.
struct Mechanism {
  model::ModelDescription description;

  explicit Mechanism(const Vector3d& gravity = {0, -9.81, 0}) { description.gravity = gravity; }

  void planar() { description.planar = spatial::Plane::xy; }

  body::BodySpec& add(const std::string& name, const Vector3d& at, double angle) {
    body::BodySpec spec;
    spec.name = name;
    spec.at.position = at;
    spec.at.orientation.emplace();
    spec.at.orientation->axis = Vector3d::UnitZ();
    spec.at.orientation->angle = angle;
    description.bodies.push_back(std::move(spec));
    return description.bodies.back();
  }

  /// Slender rigid rod along its x axis from the origin, markers "s" and "e" at the ends.
  void rigid_rod(const std::string& name, double length, double mass,
                 const Vector3d& at = {0, 0, 0}, double angle = 0) {
    body::BodySpec& spec = add(name, at, angle);
    body::RigidSpec rigid;
    rigid.mass = mass;
    rigid.com = {length / 2, 0, 0};
    const double J = mass * length * length / 12;
    rigid.inertia = {1e-3 * J, J, J};
    spec.kind = rigid;
    spec.markers.resize(2);
    spec.markers[0].name = "s";
    spec.markers[0].position = Vector3d::Zero();
    spec.markers[1].name = "e";
    spec.markers[1].position = Vector3d(length, 0, 0);
  }

  /// Flexible beam along its x axis from the origin.
  void beam(const std::string& name, double length, int elements, const Vector3d& at = {0, 0, 0},
            double angle = 0) {
    body::BodySpec& spec = add(name, at, angle);
    fem::BeamSpec kind;
    kind.to = {length, 0, 0};
    kind.elements = elements;
    fem::RectangleSpec section;
    section.width = 0.02;
    section.height = 0.03;
    kind.section.value.shape = section;
    kind.material.value.E = 2e11;
    kind.material.value.nu = 0.3;
    kind.material.value.rho = 7800;
    spec.kind = kind;
  }

  template <class Kind>
  Kind& joint(const std::string& name, const base::MarkerRef& a, const base::MarkerRef& b) {
    Kind kind;
    kind.between = {a, b};
    if constexpr (requires { kind.axis.has_value(); }) kind.axis = Vector3d::UnitZ();
    joints::JointSpec spec;
    spec.name = name;
    spec.kind = kind;
    description.joints.push_back(std::move(spec));
    return std::get<Kind>(description.joints.back().kind);
  }

  template <class Kind>
  Kind& load(const std::string& name) {
    loads::LoadSpec spec;
    spec.name = name;
    spec.kind = Kind{};
    description.loads.push_back(std::move(spec));
    return std::get<Kind>(description.loads.back().kind);
  }

  void force(const std::string& on, const Vector3d& value) {
    auto& kind = load<loads::ForceSpec>("force on " + on);
    kind.on = at_marker(on);
    kind.value = constant_law(value);
  }

  void torque(const std::string& on, const Vector3d& value) {
    auto& kind = load<loads::TorqueSpec>("torque on " + on);
    kind.on = at_marker(on);
    kind.value = constant_law(value);
  }

  std::unique_ptr<model::BuiltModel> build() const { return model::build_model(description); }
};

/// Constants of the section and material of Mechanism::beam().
inline constexpr double kE = 2e11;
inline constexpr double kArea = 0.02 * 0.03;
inline constexpr double kIz = 0.03 * 0.02 * 0.02 * 0.02 / 12;  // ∫ y² dA: bending in x-y
inline constexpr double kRhoA = 7800 * kArea;

/// Position of a marker in the world.
inline Vector3d place(const model::Model& m, const model::State& state, const std::string& body,
                      const std::string& marker) {
  model::MarkerId id;
  id.body = m.find_body(body);
  id.marker = m.bodies[static_cast<std::size_t>(id.body)].find_marker(marker);
  if (id.marker < 0) throw std::out_of_range(marker);
  return dynamics::evaluate_marker(m, id, dynamics::motions_of(m, state)).motion.p;
}

/// Largest acceleration of any frame [m/s², rad/s² times the body's size] or nodal variable.
inline double largest_acceleration(const model::Model& m, model::State state) {
  const dynamics::MassMetric metric(m);
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(m, dynamics::motions_of(m, state), state.t, constraints);
  compute_accelerations(m, metric, metric.split(constraints.rows).independent, state);
  double largest = 0.0;
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const model::BodyState& s = state.bodies[b];
    largest = std::max({largest, s.v_dot.norm(), s.w_dot.norm() * m.bodies[b].length_scale()});
    if (!m.bodies[b].is_flexible()) continue;
    for (const auto& node : m.bodies[b].flexible->fe.dofs.node_dofs) {
      for (std::size_t k = 0; k < 6; ++k) {
        if (node[k] < 0) continue;
        const double scale = k < 3 ? 1.0 : m.bodies[b].length_scale();
        largest = std::max(largest, scale * std::abs(s.d_ddot[node[k]]));
      }
    }
  }
  return largest;
}

}  // namespace buckens::analysis::test
