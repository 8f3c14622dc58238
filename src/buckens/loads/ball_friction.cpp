// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/ball_friction.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Quaterniond relative_rotation(const Sight& sight) {
  return Quaterniond(Matrix3d(sight.first.R.transpose() * sight.second.R));
}

}  // namespace

BallFriction::Stand BallFriction::look(const Sight& sight) const {
  const FrictionBound bound = bound_.at(sight);
  const FrictionData& data = bound.data();
  const Quaterniond now = relative_rotation(sight);
  Vector3d turned = Vector3d::Zero();  // in the step, axes of the first marker
  Vector3d before = Vector3d::Zero();
  if (sight.states != nullptr) {
    const double* q = sight.states;
    turned = spatial::log_rotation(now * Quaterniond(q[0], q[1], q[2], q[3]).conjugate());
    before = Eigen::Map<const Vector3d>(q + 4);
  }
  const Vector3d w = sight.second.w - sight.first.w;
  Stand out;
  out.along = sight.first.R;
  if (arms_) {
    out.along.col(0) = sight.first.R * arms_->first;
    out.along.col(1) = sight.second.R * arms_->second;
    out.along.col(2) = out.along.col(0).cross(out.along.col(1)).normalized();
  }
  out.rate = out.along.transpose() * w;
  out.strain = before + out.along.transpose() * (sight.first.R * turned);
  const double load = data.radius * sight.reaction.force.norm();
  out.stiffness = (data.static_coefficient * load + data.preload) / data.slip;
  if (out.stiffness > 0.0) {
    out.bound_per_load = data.static_coefficient / (data.static_coefficient * load + data.preload);
  }
  out.damping = 2.0 * std::sqrt(out.stiffness * data.inertia);
  out.trial = -out.stiffness * out.strain - out.damping * out.rate;
  const Vector3d& trial = out.trial;
  const auto cut = [&](int first, int count) {
    const double size = trial.segment(first, count).norm();
    const double most = bound.at(load, out.rate.segment(first, count).norm());
    const double share = size > most ? most / size : 1.0;
    out.torque.segment(first, count) = share * trial.segment(first, count);
    out.share = share;
    if (share == 1.0) {
      // After turning round in a long step its damper may make up for a broken spring.
      const double elastic = out.stiffness * out.strain.segment(first, count).norm();
      if (!(elastic > most)) return;
      out.strain.segment(first, count) *= most / elastic;
      for (int k = first; k < first + count; ++k) out.broken[static_cast<std::size_t>(k)] = true;
      return;
    }
    for (int k = first; k < first + count; ++k) out.slides[static_cast<std::size_t>(k)] = true;
    const double give = out.stiffness > 0.0 ? 1.0 / out.stiffness : 0.0;
    out.strain.segment(first, count) = -give * out.torque.segment(first, count);
  };
  out.torque.setZero();
  if (arms_) {
    cut(0, 1);
    cut(1, 1);
    out.strain[2] = 0.0;
  } else {
    cut(0, 3);
  }
  out.viscous = data.viscous;
  out.torque -= data.viscous * out.rate;
  if (arms_) out.torque[2] = 0.0;
  return out;
}

Action BallFriction::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                              const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action BallFriction::respond(const Sight& sight) const {
  const Stand s = look(sight);
  Action out;
  out.on_second.torque = s.along * s.torque;
  out.on_first.torque = -out.on_second.torque;
  out.stored_energy = 0.5 * s.stiffness * s.strain.squaredNorm();
  double power = s.torque.dot(s.rate);
  for (int k = 0; k < 3; ++k) {
    const bool slides = s.slides[static_cast<std::size_t>(k)];
    if (slides) out.regime |= 1 << k;
    if (!slides && !s.broken[static_cast<std::size_t>(k)]) {
      power += s.stiffness * s.strain[k] * s.rate[k];
    }
  }
  out.active_power = power;
  out.dissipation = -power;
  return out;
}

void BallFriction::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const Stand s = look(sight);
  for (int k = 0; k < 3; ++k) {
    SoftRow row;
    row.J.segment<3>(0) = -s.along.col(k).transpose();
    row.J.segment<3>(6) = s.along.col(k).transpose();
    // A ball that slides answers across its direction of sliding, see mix_rows().
    const bool answers = is_held(k) && !(arms_ && s.slides[static_cast<std::size_t>(k)]);
    row.stiffness = answers ? s.stiffness : 0.0;
    row.damping = (answers ? s.damping : 0.0) + (is_held(k) ? s.viscous : 0.0);
    rows.push_back(row);
  }
}

bool BallFriction::mix_rows(const Sight& sight, RowMix& mix) const {
  if (arms_) return false;
  const Stand s = look(sight);
  if (!s.slides[0]) return false;
  const Vector3d towards = (s.torque + s.viscous * s.rate).normalized();
  mix = s.share * (Matrix3d::Identity() - towards * towards.transpose());
  return true;
}

void BallFriction::append_slopes(const Sight& sight, int /*regime*/,
                                 std::vector<spatial::Wrench>& slopes) const {
  const Stand s = look(sight);
  const Vector3d pressed = bound_.at(sight).data().radius * sight.reaction.force.normalized();
  for (int k = 0; k < 3; ++k) {
    // All of the torque but the viscous part grows with the bound, whether it sticks (nearly: its
    // damper with the root) or slides.
    const double dry = is_held(k) ? s.torque[k] + s.viscous * s.rate[k] : 0.0;
    slopes.push_back({Vector3d::Zero(), dry * s.bound_per_load * pressed});
  }
}

TurningFriction::Rub BallFriction::rub(const Sight& sight) const {
  const Stand s = look(sight);
  Rub out;
  out.dry = s.torque + s.viscous * s.rate;
  out.slides = s.slides;
  out.excess = s.trial - out.dry;
  out.stiffness = s.stiffness;
  out.damping = s.damping + s.viscous;
  if (arms_) out.dry[2] = out.excess[2] = 0.0;
  return out;
}

double BallFriction::most_at_rest(const Sight& sight) const {
  const FrictionBound bound = bound_.at(sight);
  return bound.at(bound.data().radius * sight.reaction.force.norm(), 0.0);
}

void BallFriction::start_states(const Sight& sight, double* states) const {
  Sight fresh = sight;
  fresh.states = nullptr;
  find_states(fresh, states);
}

void BallFriction::find_states(const Sight& sight, double* states) const {
  const Quaterniond now = relative_rotation(sight);
  states[0] = now.w();
  Eigen::Map<Vector3d>(states + 1) = now.vec();
  Eigen::Map<Vector3d>(states + 4) = look(sight).strain;
}

}  // namespace buckens::loads
