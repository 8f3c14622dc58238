// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/ball_bristles.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Quaterniond second_in_first(const Sight& sight) {
  return Quaterniond(Matrix3d(sight.first.R.transpose() * sight.second.R));
}

}  // namespace

BallBristles::Bend BallBristles::bend(const Sight& sight, double heavier) const {
  Bend out;
  out.rate = sight.first.R.transpose() * (sight.second.w - sight.first.w);
  const FrictionBound most = bound_.at(sight);
  const double load = heavier * most.data().radius * sight.reaction.force.norm();
  const double speed = out.rate.norm();
  out.bound = most.at(load, speed);
  const double to = out.bound / bristles_.stiffness;
  if (!(to > 0.0)) {
    out.slope = out.turn = 0.0;
    return out;
  }
  const double share = bristles_.elastic_share;
  Vector3d way = Vector3d::Zero();
  if (sight.states != nullptr) {
    const double* q = sight.states;
    way = spatial::log_rotation(second_in_first(sight) *
                                Quaterniond(q[0], q[1], q[2], q[3]).conjugate());
    const double from = q[7] > 0.0 ? q[7] / bristles_.stiffness : to;
    out.z = bent_over(way, Eigen::Map<const Vector3d>(q + 4), {from, to}, share);
  }
  if (speed > 0.0) out.z_dot = speed * slope_of_bristles(out.z, out.rate / speed, to, share);
  const double size = out.z.norm();
  const double ahead = out.z.dot(out.rate) < 0.0 ? -size : size;
  out.slope = slope_of_bristles(ahead, to, share);
  // What slides far within a step points where the way goes: it turns with the way as a whole.
  out.turn = std::min(1.0, to / std::max(way.norm(), to));
  return out;
}

Vector3d BallBristles::torque(const Sight& sight, const Bend& now) const {
  return -bristles_.stiffness * now.z - bristles_.damping * now.z_dot -
         bound_.at(sight).data().viscous * now.rate;
}

Matrix3d BallBristles::directions(const Bend& now) {
  Matrix3d out = Matrix3d::Identity();
  const double size = now.z.norm();
  if (!(size > 0.0)) return out;
  out.col(0) = now.z / size;
  out.col(1) = out.col(0).unitOrthogonal();
  out.col(2) = out.col(0).cross(out.col(1));
  return out;
}

Action BallBristles::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                              const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action BallBristles::respond(const Sight& sight) const {
  const Bend now = bend(sight);
  const Vector3d own = torque(sight, now);
  Action out;
  out.on_second.torque = sight.first.R * own;
  out.on_first.torque = -out.on_second.torque;
  out.stored_energy = 0.5 * bristles_.stiffness * now.z.squaredNorm();
  out.active_power = own.dot(now.rate) + bristles_.stiffness * now.z.dot(now.z_dot);
  out.dissipation = -out.active_power;
  // Bristles bend over steps or within one: their tangent is formed again as their slope falls.
  out.regime = now.slope > kHardlyBent ? 0 : now.slope > 0.5 * kHardlyBent ? 1 : 2;
  return out;
}

void BallBristles::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const Bend now = bend(sight);
  const Matrix3d along = sight.first.R * directions(now);
  const double viscous = bound_.at(sight).data().viscous;
  for (int k = 0; k < 3; ++k) {
    SoftRow row;
    row.J.segment<3>(0) = -along.col(k).transpose();
    row.J.segment<3>(6) = along.col(k).transpose();
    const double share = k == 0 ? std::max(0.0, now.slope) : now.turn;
    row.stiffness = share * bristles_.stiffness;
    row.damping = share * bristles_.damping + viscous;
    rows.push_back(row);
  }
}

void BallBristles::append_slopes(const Sight& sight, int /*regime*/,
                                 std::vector<spatial::Wrench>& slopes) const {
  // Across a whole step z has no simple derivative: a difference. The load grows with the reaction.
  const Vector3d change =
      torque(sight, bend(sight, 1.0 + kHeavier)) - torque(sight, bend(sight, 1.0 - kHeavier));
  const double size = sight.reaction.force.norm();
  const Vector3d per_force =
      size > 0.0 ? Vector3d(change / (2.0 * kHeavier * size)) : Vector3d(Vector3d::Zero());
  const Vector3d towards = size > 0.0 ? Vector3d(sight.reaction.force / size) : per_force;
  const Matrix3d along = directions(bend(sight));
  for (int k = 0; k < 3; ++k) {
    slopes.push_back({Vector3d::Zero(), along.col(k).dot(per_force) * towards});
  }
}

double BallBristles::most_at_rest(const Sight& sight) const {
  const FrictionBound bound = bound_.at(sight);
  return bound.at(bound.data().radius * sight.reaction.force.norm(), 0.0);
}

void BallBristles::start_states(const Sight& sight, double* states) const {
  Sight fresh = sight;
  fresh.states = nullptr;
  find_states(fresh, states);
}

void BallBristles::find_states(const Sight& sight, double* states) const {
  const Quaterniond rotation = second_in_first(sight);
  const Bend now = bend(sight);
  states[0] = rotation.w();
  Eigen::Map<Vector3d>(states + 1) = rotation.vec();
  Eigen::Map<Vector3d>(states + 4) = now.z;
  states[7] = now.bound;
}

}  // namespace buckens::loads
