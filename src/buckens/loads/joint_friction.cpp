// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/joint_friction.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {
constexpr double kAtOnce = 1e-3;  // [s]
}  // namespace

void JointFriction::start_states(const Sight& sight, double* states) const {
  const double rate = sight.coordinate.rate;
  const double slip = bound_.data().slip;
  if (std::abs(rate) * kAtOnce > slip) states[0] = std::copysign(slip, rate);
}

double FrictionBound::load(const Sight& sight) const {
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

double FrictionBound::coefficient(double rate) const {
  const double slowness = data_.stribeck_rate > 0.0 ? std::abs(rate) / data_.stribeck_rate : 0.0;
  return data_.dynamic_coefficient +
         (data_.static_coefficient - data_.dynamic_coefficient) * std::exp(-slowness * slowness);
}

ProjectedForce JointFriction::force(const Sight& sight) const {
  const FrictionData& data = bound_.data();
  const double load = bound_.load(sight);
  ProjectedForce out;
  out.is_yielding = true;
  out.strain = (sight.states != nullptr ? sight.states[0] : 0.0) + sight.coordinate.change;
  out.highest = bound_.at(load, sight.coordinate.rate);
  out.lowest = -out.highest;
  out.stiffness = (data.static_coefficient * load + data.preload) / data.slip;
  // Critical for the moving inertia: sticking does not stop a vibration above its bound.
  out.damping = 2.0 * std::sqrt(out.stiffness * data.inertia);
  out.outer_damping = data.viscous;
  return out;
}

void RigidFriction::start_states(const Sight& sight, double* states) const {
  const double rate = sight.coordinate.rate;
  states[0] = std::abs(rate) * kAtOnce <= bound_.data().slip ? 1 : rate > 0.0 ? 2 : 3;
}

RigidRow RigidFriction::row(const Sight& sight) const {
  const double rate = sight.coordinate.rate;
  const double load = bound_.load(sight);
  RigidRow out;
  out.next = sight.stand;
  out.is_closed = sight.stand.regime <= 1;
  out.slip = rate;
  if (out.is_closed) {
    const double most = bound_.at(load, 0.0);
    if (std::abs(sight.stand.force) > most) {
      out.next = {sight.stand.force < 0.0 ? 2 : 3, std::copysign(most, sight.stand.force)};
    }
    return out;
  }
  const double direction = sight.stand.regime == 2 ? 1.0 : -1.0;
  out.given = -direction * bound_.at(load, rate) - bound_.data().viscous * rate;
  if (direction * rate < 0.0) out.next = {1, out.given};
  return out;
}

}  // namespace buckens::loads
