// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/ball_bristles.h"

#include "buckens/spatial/rotation.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Quaterniond second_in_first(const Sight& sight) {
  return Quaterniond(Matrix3d(sight.first.R.transpose() * sight.second.R));
}

/// What its rows are multiplied with, so that none of their mix is larger than one.
double scale_of(const Matrix3d& slopes) { return slopes.colwise().norm().maxCoeff(); }

}  // namespace

BallBristles::Bend BallBristles::bend(const Sight& sight, double heavier) const {
  Bend out;
  out.rate = sight.first.R.transpose() * (sight.second.w - sight.first.w);
  const FrictionBound most = bound_.at(sight);
  const double load = heavier * most.data().radius * sight.reaction.force.norm();
  out.viscous = most.data().viscous;
  out.bound = most.at(load, out.rate.norm());
  const double to = out.bound / bristles_.stiffness;
  if (!(to > 0.0)) return out;
  out.way.sliding = {to, to};
  if (sight.states != nullptr) {
    const double* q = sight.states;
    const Quaterniond before(q[0], q[1], q[2], q[3]);
    out.way.turned = spatial::log_rotation(second_in_first(sight) * before.conjugate());
    out.way.z = Eigen::Map<const Vector3d>(q + 4);
    if (q[7] > 0.0) out.way.sliding[0] = q[7] / bristles_.stiffness;
    out.z = bending_.after(out.way);
  }
  out.z_dot = bending_.rate(out.z, out.rate, to);
  out.slips = !(out.z.norm() <= bristles_.elastic_share * to);
  return out;
}

Vector3d BallBristles::torque(const Bend& now) const {
  return -bristles_.stiffness * now.z - bristles_.damping * now.z_dot - now.viscous * now.rate;
}

BallBristles::Tangent BallBristles::tangent(const Bend& now) const {
  const Matrix3d I = Matrix3d::Identity();
  if (!(now.bound > 0.0)) return {Matrix3d::Zero(), now.viscous * I};
  const BallBending::Slopes slopes = bending_.slopes(now.z, now.rate, now.way.sliding[1]);
  return {(bristles_.stiffness * I + bristles_.damping * slopes.by_z) * bending_.by_turn(now.way),
          bristles_.damping * slopes.by_rate + now.viscous * I};
}

Action BallBristles::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                              const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action BallBristles::respond(const Sight& sight) const {
  const Bend now = bend(sight);
  const Vector3d own = torque(now);
  Action out;
  out.on_second.torque = sight.first.R * own;
  out.on_first.torque = -out.on_second.torque;
  out.stored_energy = 0.5 * bristles_.stiffness * now.z.squaredNorm();
  out.active_power = own.dot(now.rate) + bristles_.stiffness * now.z.dot(now.z_dot);
  out.dissipation = -out.active_power;
  out.regime = now.slips ? 7 : 0;
  return out;
}

void BallBristles::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const Tangent slopes = tangent(bend(sight));
  const double stiffness = scale_of(slopes.stiffness), damping = scale_of(slopes.damping);
  for (int k = 0; k < 6; ++k) {
    SoftRow row;
    row.J.segment<3>(0) = -sight.first.R.col(k % 3).transpose();
    row.J.segment<3>(6) = sight.first.R.col(k % 3).transpose();
    (k < 3 ? row.stiffness : row.damping) = k < 3 ? stiffness : damping;
    rows.push_back(row);
  }
}

bool BallBristles::mix_rows(const Sight& sight, RowMix& mix) const {
  const Bend now = bend(sight);
  if (!now.slips) return false;
  const Tangent slopes = tangent(now);
  const double stiffness = scale_of(slopes.stiffness), damping = scale_of(slopes.damping);
  mix.setIdentity(6, 6);
  if (stiffness > 0.0) mix.topLeftCorner<3, 3>() = slopes.stiffness / stiffness;
  if (damping > 0.0) mix.bottomRightCorner<3, 3>() = slopes.damping / damping;
  return true;
}

void BallBristles::append_slopes(const Sight& sight, int /*regime*/,
                                 std::vector<spatial::Wrench>& slopes) const {
  // Across a whole step z has no simple derivative: a difference. The load grows with the reaction.
  const double size = sight.reaction.force.norm();
  Vector3d per_force = Vector3d::Zero(), towards = Vector3d::Zero();
  if (size > 0.0) {
    const Vector3d change =
        torque(bend(sight, 1.0 + kHeavier)) - torque(bend(sight, 1.0 - kHeavier));
    per_force = change / (2.0 * kHeavier * size);
    towards = sight.reaction.force / size;
  }
  for (int k = 0; k < 3; ++k) slopes.push_back({Vector3d::Zero(), per_force[k] * towards});
}

TurningFriction::Rub BallBristles::rub(const Sight& sight) const {
  const Bend now = bend(sight);
  Rub out;
  out.dry = -bristles_.stiffness * now.z;
  out.excess = -bristles_.stiffness * (now.way.z + now.way.turned - now.z);
  out.slides.fill(now.slips);
  out.stiffness = bristles_.stiffness;
  return out;
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
