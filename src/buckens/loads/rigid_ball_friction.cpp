// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/rigid_ball_friction.h"

#include <cmath>

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Cosine of the angle by which the direction of sliding may turn within a step. What turns more is
// about to stand still: friction that turned with it would have no end.
constexpr double kTurnsOn = 0.5;
// Action::regime of sliding whose tangent is that of a direction that turns with ω.
constexpr int kFollowsSlip = -1;

}  // namespace

Vector3d RigidBallFriction::rate(const Sight& sight) {
  return sight.first.R.transpose() * (sight.second.w - sight.first.w);
}

double RigidBallFriction::most(const Sight& sight, double speed) const {
  return bound_.ask(sight, [&](const FrictionBound& bound) {
    return bound.at(bound.data().radius * sight.reaction.force.norm(), speed);
  });
}

RigidBallFriction::Turn RigidBallFriction::look(const Sight& sight) const {
  Turn out;
  out.rate = rate(sight);
  out.torque = sight.first.R.transpose() * sight.reaction.torque;
  out.speed = out.rate.norm();
  out.bound = most(sight, out.speed);
  const double size = out.torque.norm();
  if (size > 0.0) out.towards = -out.torque / size;
  if (sight.stand.regime >= kHeldDirection) return out;
  const bool goes_on = out.rate.dot(out.towards) >= kTurnsOn * out.speed * out.towards.norm();
  out.follows = goes_on && out.speed > kAtRest;
  if (out.follows) out.towards = out.rate / out.speed;
  return out;
}

RigidRow RigidBallFriction::row(const Sight& sight) const {
  RigidRow out;
  const Turn now = look(sight);
  out.next = sight.stand;
  out.slip = now.rate[axis_];
  out.is_closed = sight.stand.regime <= 1;
  if (out.is_closed) {
    const double limit = most(sight, 0.0);
    const double size = now.torque.norm();
    if (size > limit) out.next = {2, now.torque[axis_] * (limit / size)};
    return out;
  }
  out.given = -now.bound * now.towards[axis_] - viscous(sight) * now.rate[axis_];
  if (sight.stand.regime >= kHeldDirection) return out;
  // What has turned round since the step began has stood still between.
  const bool began_sliding = sight.states != nullptr && sight.states[0] == 2.0;
  const bool has_turned = now.rate.dot(now.torque) > kAtRest * now.torque.norm();
  if (has_turned && began_sliding) out.next = {1, out.given};
  return out;
}

Action RigidBallFriction::respond(const Sight& sight) const {
  Action out = RigidLaw::respond(sight);
  if (sight.stand.regime >= 2 && look(sight).follows) out.regime = kFollowsSlip;
  return out;
}

void RigidBallFriction::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  RigidLaw::append_tangent(sight, rows);
  if (sight.stand.regime < 2) return;
  const Turn now = look(sight);
  rows.back().damping = viscous(sight);
  if (now.follows) rows.back().damping += now.bound / now.speed;
}

bool RigidBallFriction::mix_rows(const Sight& sight, RowMix& mix) const {
  if (axis_ != kRows - 1 || sight.stand.regime < 2) return false;
  const Turn now = look(sight);
  if (!now.follows || !(now.bound > 0.0)) return false;
  // (b/|ω| + c) (1 − s n nᵀ): along n only the viscous part answers.
  const double across = now.bound / now.speed;
  const double share = across / (across + viscous(sight));
  mix = Matrix3d::Identity() - share * now.towards * now.towards.transpose();
  return true;
}

void RigidBallFriction::append_slopes(const Sight& sight, int /*regime*/,
                                      std::vector<spatial::Wrench>& slopes) const {
  spatial::Wrench out;
  // Rows that are closed have whatever force keeps them closed.
  if (sight.stand.regime >= 2) {
    const Turn now = look(sight);
    const FrictionBound bound = bound_.at(sight);
    const double growth = -bound.coefficient(now.speed) * now.towards[axis_];
    out.force = growth * bound.data().radius * sight.reaction.force.normalized();
  }
  slopes.push_back(out);
}

void RigidBallFriction::start_states(const Sight& sight, double* states) const {
  states[0] = struck_regime(sight, kAtRest);
}

int RigidBallFriction::struck_regime(const Sight& sight, double rounding) const {
  return rate(sight).norm() <= rounding ? 1 : 2;
}

void RigidBallFriction::find_states(const Sight& sight, double* states) const {
  RigidLaw::find_states(sight, states);
  if (sight.stand.regime < 2) return;
  states[0] = 2;
  // The next step begins with the direction that this one has ended with.
  const Turn now = look(sight);
  if (now.speed > kAtRest) states[1] = -now.bound * now.rate[axis_] / now.speed;
}

}  // namespace buckens::loads
