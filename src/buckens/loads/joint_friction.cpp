// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/joint_friction.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/end_of_set.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {
constexpr double kAtOnce = 1e-3;  // [s]

/// R v, written out: Eigen calls a function for it, and every iteration of a step comes by here.
inline Vector3d axis_in_world(const Eigen::Matrix3d& R, const Vector3d& v) {
  return R.col(0) * v[0] + R.col(1) * v[1] + R.col(2) * v[2];
}
}  // namespace

bool FrictionLaws::uses_signals() const {
  return static_coefficient.uses_signals() || dynamic_coefficient.uses_signals() ||
         viscous.uses_signals() || preload.uses_signals();
}

bool FrictionLaws::is_constant() const {
  return static_coefficient.is_constant() && dynamic_coefficient.is_constant() &&
         viscous.is_constant() && preload.is_constant();
}

void FrictionLaws::set(const Sight& sight, FrictionData& data) const {
  const auto now = [&](const base::SignalLaw& law) {
    return std::max(0.0, law.value(sight.t, sight.signals));
  };
  data.static_coefficient = now(static_coefficient);
  data.dynamic_coefficient = std::min(now(dynamic_coefficient), data.static_coefficient);
  data.viscous = now(viscous);
  data.preload = now(preload);
}

DrivenBound::DrivenBound(const FrictionData& data, const Vector3d& axis_F,
                         std::optional<FrictionLaws> laws)
    : constant_(data, axis_F) {
  if (laws && laws->is_constant()) {
    FrictionData given = data;
    laws->set({0.0, {}, {}}, given);
    constant_ = FrictionBound(given, axis_F);
  } else {
    laws_ = std::move(laws);
  }
}

FrictionBound DrivenBound::at(const Sight& sight) const {
  if (!laws_) return constant_;
  FrictionData now = constant_.data();
  laws_->set(sight, now);
  return {now, constant_.axis()};
}

void JointFriction::start_states(const Sight& sight, double* states) const {
  const double rate = sight.coordinate.rate;
  const double slip = bound_.at(sight).data().slip;
  if (std::abs(rate) * kAtOnce > slip) states[0] = std::copysign(slip, rate);
}

double FrictionBound::load(const Sight& sight) const {
  const Vector3d axis = axis_in_world(sight.first.R, axis_F_);
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
  if (data_.pins_radius > 0.0) out += data_.pins_radius * force.norm();
  return out;
}

spatial::Wrench FrictionBound::load_slope(const Sight& sight, double factor) const {
  const Vector3d axis = axis_in_world(sight.first.R, axis_F_);
  const auto along = [&](const Vector3d& v) -> Vector3d {
    return v.dot(axis) < 0.0 ? Vector3d(-axis) : axis;
  };
  const auto across = [&](const Vector3d& v) -> Vector3d {
    return Vector3d(v - axis * v.dot(axis)).normalized();  // zero remains zero
  };
  const Vector3d& force = sight.reaction.force;
  const Vector3d& torque = sight.reaction.torque;
  spatial::Wrench out;
  out.force = factor * (data_.radius * across(force) + data_.axial_radius * along(force));
  if (data_.bearing_length > 0.0) {
    out.torque += factor * data_.radius / (0.5 * data_.bearing_length) * across(torque);
  }
  if (data_.torque_radius > 0.0) out.torque += factor / data_.torque_radius * along(torque);
  if (data_.pins_radius > 0.0) out.force += factor * data_.pins_radius * force.normalized();
  return out;
}

double FrictionBound::coefficient(double rate) const {
  if (data_.static_coefficient == data_.dynamic_coefficient) return data_.dynamic_coefficient;
  const double slowness = data_.stribeck_rate > 0.0 ? std::abs(rate) / data_.stribeck_rate : 0.0;
  return data_.dynamic_coefficient +
         (data_.static_coefficient - data_.dynamic_coefficient) * std::exp(-slowness * slowness);
}

ProjectedForce JointFriction::force(const Sight& sight) const {
  ProjectedForce out;
  out.is_yielding = true;
  out.strain = strain(sight);
  bound_.ask(sight, [&](const FrictionBound& bound) {
    const FrictionData& data = bound.data();
    const double load = bound.load(sight);
    out.highest = bound.at(load, sight.coordinate.rate);
    out.lowest = -out.highest;
    out.stiffness = (data.static_coefficient * load + data.preload) / data.slip;
    // Critical for the moving inertia: sticking does not stop a vibration above its bound.
    out.damping = 2.0 * std::sqrt(out.stiffness * data.inertia);
    out.outer_damping = data.viscous;
  });
  return out;
}

bool JointFriction::slide_on(const FrictionBound& bound, const Sight& sight,
                             CoordinateResponse& out) const {
  const FrictionData& data = bound.data();
  const double x = strain(sight), rate = sight.coordinate.rate;
  const double load = bound.load(sight);
  const double held = data.static_coefficient * load + data.preload;
  const double most = bound.at(load, rate);
  // Without a bound the sign of its zero force would tell the regime.
  const bool is_pushed = x * rate > 0.0 && most > 0.0;
  if (!is_pushed || !(std::abs(x) * held > most * data.slip)) return false;
  const double kept = most == held ? data.slip : data.slip * (most / held);
  out.force = -std::copysign(most, rate) - data.viscous * rate;
  out.strain = std::copysign(kept, rate);
  out.stored_energy = 0.5 * most * kept;
  out.active_power = out.force * rate;
  out.dissipation = -out.active_power;
  out.regime = EndOfSet::regime(-rate, 0.0);
  return true;
}

CoordinateResponse JointFriction::answer(const Sight& sight) const {
  CoordinateResponse out;
  const bool slides_on =
      bound_.ask(sight, [&](const FrictionBound& bound) { return slide_on(bound, sight, out); });
  return slides_on ? out : CoordinateLaw::answer(sight);
}

void JointFriction::append_slopes(const Sight& sight, int regime,
                                  std::vector<spatial::Wrench>& out) const {
  bound_.ask(sight, [&](const FrictionBound& bound) {
    const double rate = sight.coordinate.rate;
    double growth = regime * bound.coefficient(rate);  // slides: ±b
    if (regime == 0) {
      const ProjectedForce law = force(sight);
      // The spring grows with the bound, its damper with the root of it.
      const double per_load = bound.data().static_coefficient / bound.data().slip;
      const double damping = law.stiffness > 0.0 ? law.damping / law.stiffness : 0.0;
      growth = -per_load * (law.strain + 0.5 * damping * rate);
    }
    out.push_back(bound.load_slope(sight, growth));
  });
}

void RigidFriction::start_states(const Sight& sight, double* states) const {
  const double rate = sight.coordinate.rate;
  states[0] = std::abs(rate) * kAtOnce <= bound_.at(sight).data().slip ? 1 : rate > 0.0 ? 2 : 3;
}

int RigidFriction::struck_regime(const Sight& sight, double rounding) const {
  const double rate = sight.coordinate.rate;
  return std::abs(rate) <= rounding ? 1 : rate > 0.0 ? 2 : 3;
}

RigidRow RigidFriction::row(const Sight& sight) const {
  const double rate = sight.coordinate.rate;
  const FrictionBound bound = bound_.at(sight);
  const double load = bound.load(sight);
  RigidRow out;
  out.next = sight.stand;
  out.is_closed = sight.stand.regime <= 1;
  out.slip = rate;
  if (out.is_closed) {
    const double most = bound.at(load, 0.0);
    if (std::abs(sight.stand.force) > most) {
      out.next = {sight.stand.force < 0.0 ? 2 : 3, std::copysign(most, sight.stand.force)};
    }
    return out;
  }
  const double direction = sight.stand.regime == 2 ? 1.0 : -1.0;
  out.given = -direction * bound.at(load, rate) - bound.data().viscous * rate;
  if (direction * rate < 0.0) out.next = {1, out.given};
  return out;
}

void RigidFriction::append_slopes(const Sight& sight, int /*regime*/,
                                  std::vector<spatial::Wrench>& out) const {
  // A row that is closed has whatever force keeps it closed.
  const int regime = sight.stand.regime;
  const double direction = regime == 2 ? 1.0 : regime == 3 ? -1.0 : 0.0;
  const FrictionBound bound = bound_.at(sight);
  out.push_back(bound.load_slope(sight, -direction * bound.coefficient(sight.coordinate.rate)));
}

}  // namespace buckens::loads
