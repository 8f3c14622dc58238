// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/loads/bushing.h"
#include "buckens/loads/spring_damper.h"

namespace buckens::test {

/// Uniform rigid rod along its x axis, with a small inertia about it.
inline int add_rod(Mechanism& m, double mass, double length, const spatial::Pose& X) {
  const double J = mass * length * length / 12.0;
  return m.add_rigid(mass, Eigen::Vector3d(0.01 * J, J, J).asDiagonal(), X);
}

/// Two equal rigid rods of 1 kg and 1 m in a row along x, hinged about z to the ground and to each
/// other; in space or planar.
inline model::Model rigid_double_pendulum(bool planar) {
  Mechanism m(planar ? std::optional(spatial::Plane::xy) : std::nullopt);
  m.set_gravity({0, -9.81, 0});
  const int upper = add_rod(m, 1.0, 1.0, {{0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  const int lower = add_rod(m, 1.0, 1.0, {{1.5, 0, 0}, Eigen::Quaterniond::Identity()});
  m.add_joint(joints::JointType::revolute, Mechanism::ground({0, 0, 0}),
              m.rigid_marker(upper, {-0.5, 0, 0}));
  m.add_joint(joints::JointType::revolute, m.rigid_marker(upper, {0.5, 0, 0}),
              m.rigid_marker(lower, {-0.5, 0, 0}));
  return m.take();
}

/// Planar beam pinned at the origin, horizontal along +x, under gravity along −y. Marker 0 is the
/// pin; the tip is the last node.
inline model::Model planar_beam_pendulum(const BeamConstants& beam,
                                         const body::CouplingChoice& coupling = {}) {
  Mechanism m(spatial::Plane::xy);
  m.set_gravity({0, -9.81, 0});
  m.set_length(beam.L);
  const int body = m.add_flexible(straight_beam(beam, spatial::Plane::xy), coupling, {});
  m.add_joint(joints::JointType::revolute, Mechanism::ground({0, 0, 0}), m.node_marker(body, 0));
  return m.take();
}

/// Beam in space on a spherical joint at the origin, along +x, under gravity along −z.
inline model::Model spatial_beam_pendulum(const BeamConstants& beam,
                                          const body::CouplingChoice& coupling = {}) {
  Mechanism m;
  m.set_gravity({0, 0, -9.81});
  m.set_length(beam.L);
  const int body = m.add_flexible(straight_beam(beam), coupling, {});
  m.add_joint(joints::JointType::spherical, Mechanism::ground({0, 0, 0}), m.node_marker(body, 0));
  return m.take();
}

/// Crank of 0.15 m driven at 150 rad/s, elastic steel rod of 0.3 m and 6 mm, slider of 33 g on x.
inline model::Model slider_crank(int elements, const body::CouplingChoice& coupling = {}) {
  Mechanism m(spatial::Plane::xy);
  m.set_length(0.45);
  const double A = M_PI * 0.003 * 0.003;
  const double I = 0.25 * A * 0.003 * 0.003;
  BeamConstants rod;
  rod.L = 0.3;
  rod.rhoA = 7870.0 * A;
  rod.EA = 2e11 * A;
  rod.EIy = rod.EIz = 2e11 * I;
  rod.elements = elements;
  const int crank = add_rod(m, 0.36, 0.15, {{0.075, 0, 0}, Eigen::Quaterniond::Identity()});
  const int beam = m.add_flexible(straight_beam(rod, spatial::Plane::xy), coupling,
                                  {{0.15, 0, 0}, Eigen::Quaterniond::Identity()});
  const int slider = m.add_rigid(0.033, Eigen::Matrix3d::Identity() * 1e-6,
                                 {{0.45, 0, 0}, Eigen::Quaterniond::Identity()});
  const auto hub = m.rigid_marker(crank, {-0.075, 0, 0});
  m.add_joint(joints::JointType::revolute, Mechanism::ground({0, 0, 0}), hub);
  const base::TimeLaw angle = base::TimeLaw::expression(base::Expression("150*t", {"t"}, {}, {}));
  m.add_joint(joints::JointType::prescribed_rotation, Mechanism::ground({0, 0, 0}), hub,
              Eigen::Vector3d::UnitZ(), angle);
  m.add_joint(joints::JointType::revolute, m.rigid_marker(crank, {0.075, 0, 0}),
              m.node_marker(beam, 0));
  const auto pin = m.rigid_marker(slider, {0, 0, 0});
  m.add_joint(joints::JointType::revolute, m.node_marker(beam, elements), pin);
  m.add_joint(joints::JointType::prismatic, Mechanism::ground({0.45, 0, 0}), pin,
              Eigen::Vector3d::UnitX());
  return m.take();
}

/// A damped elastic beam in space, clamped softly to a hinged rigid rod by a bushing with damping,
/// and held at its tip by a spring–damper to the ground.
inline model::Model bushed_beam(const BeamConstants& beam) {
  Mechanism m;
  m.set_gravity({0, 0, -9.81});
  m.set_length(2.0);
  const int rod = add_rod(m, 1.5, 1.0, {{0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  const int body = m.add_flexible(straight_beam(beam), body::CouplingLevel::full,
                                  {{1, 0, 0}, Eigen::Quaterniond::Identity()});
  m.add_joint(joints::JointType::revolute, Mechanism::ground({0, 0, 0}),
              m.rigid_marker(rod, {-0.5, 0, 0}), Eigen::Vector3d::UnitY());
  loads::Bushing::Coefficients k;
  k.stiffness << 4e3, 3e3, 5e3;
  k.rotational_stiffness << 30, 40, 50;
  k.damping << 2, 3, 1;
  k.rotational_damping << 0.05, 0.04, 0.06;
  m.add_load(
      std::make_unique<loads::Bushing>(k, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()),
      m.rigid_marker(rod, {0.5, 0, 0}), m.node_marker(body, 0));
  m.add_load(std::make_unique<loads::SpringDamper>(200.0, 1.5, 1.2, std::nullopt),
             Mechanism::ground({2, 0.3, 1}), m.node_marker(body, beam.elements));
  return m.take();
}

}  // namespace buckens::test
