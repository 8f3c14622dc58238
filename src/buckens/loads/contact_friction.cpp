// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_friction.h"

#include <cmath>

namespace buckens::loads {

using Eigen::Vector2d;

namespace {

// A force beyond the cone by this share is rounding, above all where places share a load.
constexpr double kOnCone = 1e-9;
// A force along the surface by this share of what presses is rounding of directions.
constexpr double kNoForce = 1e-13;
// Cosine of the angle by which the direction of sliding may turn within a step. What turns more is
// about to stand still: friction that turned with it would have no end.
constexpr double kGoesOn = 0.5;

}  // namespace

double ContactFrictionData::coefficient(double speed) const {
  const double slowness = stribeck_speed > 0.0 ? speed / stribeck_speed : 0.0;
  return dynamic_coefficient +
         (static_coefficient - dynamic_coefficient) * std::exp(-slowness * slowness);
}

ContactFrictionData ContactFriction::data_at(std::span<const double> signals) const {
  ContactFrictionData out = data_;
  if (settings_.changes_friction()) settings_.put(signals, out);
  return out;
}

bool ContactFriction::began_sliding(const Sight& sight) {
  return sight.states != nullptr && sight.states[0] == 2.0;
}

ContactFriction::Slip ContactFriction::slip(const Sight& sight) const {
  const spatial::TouchPlace place = touch_.look(sight.first, sight.second);
  const Eigen::Vector3d v = place.velocity(sight.first, sight.second);
  Slip out;
  out.touches = place.touches;
  out.load = place.normal.dot(sight.reaction.force);
  for (int k = 0; k < touch_.num_directions(); ++k) {
    const Eigen::Vector3d& along = place.along[static_cast<std::size_t>(k)];
    out.velocity[k] = along.dot(v);
    out.force[k] = along.dot(sight.reaction.force);
  }
  if (out.force.norm() <= kNoForce * std::abs(out.load)) out.force.setZero();
  out.speed = out.velocity.norm();
  if (out.force.norm() > 0.0) out.towards = -out.force.normalized();
  if (sight.stand.regime >= kHeldDirection) return out;
  const bool goes_on = out.velocity.dot(out.towards) >= kGoesOn * out.speed * out.towards.norm();
  if (goes_on && out.speed > data_.at_rest) out.towards = out.velocity / out.speed;
  return out;
}

RigidRow ContactFriction::row(const Sight& sight) const {
  RigidRow out;
  const Slip now = slip(sight);
  if (sight.stand.regime != 0 && !now.touches) {
    out.has_gone = true;
    return out;
  }
  out.next = sight.stand;
  out.slip = now.velocity[direction_];
  out.is_closed = sight.stand.regime == 1;
  if (!(now.load > 0.0)) {
    if (sight.stand.regime != 0) out.next = {};
    return out;
  }
  if (sight.stand.regime == 0) {
    out.next = {now.speed > data_.at_rest ? 2 : 1, 0.0};
    return out;
  }
  const double given =
      -data_at(sight.signals).coefficient(now.speed) * now.load * now.towards[direction_];
  if (out.is_closed) {
    const double most = data_at(sight.signals).static_coefficient * now.load;
    const double size = now.force.norm();
    if (size > most * (1.0 + kOnCone)) out.next = {2, now.force[direction_] * (most / size)};
    return out;
  }
  out.given = given;
  // What has turned round since the step began has stood still between.
  if (sight.stand.regime >= kHeldDirection) return out;
  const bool has_turned = now.velocity.dot(now.force) > data_.at_rest * now.force.norm();
  if (has_turned && began_sliding(sight)) out.next = {1, given};
  return out;
}

void ContactFriction::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  RigidLaw::append_tangent(sight, rows);
  if (sight.stand.regime != 2) return;
  const Slip now = slip(sight);
  if (!(now.speed > data_.at_rest) || !(now.load > 0.0)) return;
  // The direction of sliding answers what comes across it.
  const double ahead = now.towards[direction_];
  rows.back().damping =
      data_at(sight.signals).coefficient(now.speed) * now.load / now.speed * (1.0 - ahead * ahead);
}

void ContactFriction::find_states(const Sight& sight, double* states) const {
  RigidLaw::find_states(sight, states);
  if (sight.stand.regime < 2) return;
  states[0] = 2;
  // The next step begins with the direction that this one has ended with.
  const Slip now = slip(sight);
  if (!(now.speed > data_.at_rest)) return;
  states[1] = -data_at(sight.signals).coefficient(now.speed) * now.load * now.velocity[direction_] /
              now.speed;
}

double ContactFriction::slope(const Sight& sight) const {
  if (sight.stand.regime < 2) return 0.0;
  const Slip now = slip(sight);
  return -data_at(sight.signals).coefficient(now.speed) * now.towards[direction_];
}

}  // namespace buckens::loads
