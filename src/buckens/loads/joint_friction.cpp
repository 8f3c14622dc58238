// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/joint_friction.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {
constexpr double kAtOnce = 1e-3;  // [s]
}  // namespace

void JointFriction::start_states(const Sight& sight, double* states) const {
  const double rate = sight.coordinate.rate;
  if (std::abs(rate) * kAtOnce > data_.slip) states[0] = std::copysign(data_.slip, rate);
}

double JointFriction::load(const Sight& sight) const {
  const Vector3d axis = sight.first.R * axis_F_;
  const auto along = [&](const Vector3d& v) { return std::abs(v.dot(axis)); };
  const auto across = [&](const Vector3d& v) { return Vector3d(v - axis * v.dot(axis)).norm(); };
  const Vector3d& force = sight.reaction.force;
  const Vector3d& torque = sight.reaction.torque;
  double out = data_.radius * across(force) + data_.axial_radius * along(force);
  // Bending is carried by two forces at the ends of the bearing.
  if (data_.bearing_length > 0.0) {
    out += data_.radius * across(torque) / (0.5 * data_.bearing_length);
  }
  if (data_.torque_radius > 0.0) out += along(torque) / data_.torque_radius;
  return out;
}

ProjectedForce JointFriction::force(const Sight& sight) const {
  const double normal = load(sight);
  const double rate = std::abs(sight.coordinate.rate);
  const double slowness = data_.stribeck_rate > 0.0 ? rate / data_.stribeck_rate : 0.0;
  const double mu =
      data_.dynamic_coefficient +
      (data_.static_coefficient - data_.dynamic_coefficient) * std::exp(-slowness * slowness);
  ProjectedForce out;
  out.is_yielding = true;
  out.strain = (sight.states != nullptr ? sight.states[0] : 0.0) + sight.coordinate.change;
  out.highest = mu * normal + data_.preload;
  out.lowest = -out.highest;
  out.stiffness = (data_.static_coefficient * normal + data_.preload) / data_.slip;
  // Critical for the moving inertia: sticking does not stop a vibration above its bound.
  out.damping = 2.0 * std::sqrt(out.stiffness * data_.inertia);
  out.outer_damping = data_.viscous;
  return out;
}

}  // namespace buckens::loads
