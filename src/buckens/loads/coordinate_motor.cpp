// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/coordinate_motor.h"

#include <algorithm>

namespace buckens::loads {

namespace {

/// Whether any of the laws given has a property.
template <class Property>
bool any(const MotorData& data, Property&& property) {
  for (const auto* law : {&data.force, &data.position, &data.speed}) {
    if (*law && property(**law)) return true;
  }
  return property(data.stiffness) || property(data.damping) || property(data.limit) ||
         property(data.power);
}

double from_zero(const base::SignalLaw& law, const Sight& sight) {
  return std::max(0.0, law.value(sight.t, sight.signals));
}

}  // namespace

bool CoordinateMotor::uses_signals() const {
  return any(data_, [](const base::SignalLaw& law) { return law.uses_signals(); });
}

bool CoordinateMotor::is_constant() const {
  return !any(data_, [](const base::SignalLaw& law) { return !law.is_constant(); });
}

ProjectedForce CoordinateMotor::force(const Sight& sight) const {
  const auto value = [&](const std::optional<base::SignalLaw>& law) {
    return law ? law->value(sight.t, sight.signals) : 0.0;
  };
  const double rate = sight.coordinate.rate;
  double aimed = value(data_.speed);
  if (!data_.speed && data_.position) aimed = data_.position->rate(sight.t);
  ProjectedForce out;
  out.is_source = true;
  out.stiffness = from_zero(data_.stiffness, sight);
  if (out.stiffness > 0.0) out.strain = sight.coordinate.value - value(data_.position);
  out.damping = from_zero(data_.damping, sight);
  out.drive = out.damping * aimed + value(data_.force);
  out.highest = from_zero(data_.limit, sight);
  out.lowest = -out.highest;
  const double power = from_zero(data_.power, sight);
  if (rate == 0.0 || power == HUGE_VAL) return out;
  // Only while it drives: towards the motion.
  const double most = power / std::abs(rate);
  if (most >= out.highest) return out;
  (rate > 0.0 ? out.highest : out.lowest) = std::copysign(most, rate);
  const double trial = out.drive - out.stiffness * out.strain - out.damping * rate;
  if (trial * rate > 0.0) out.cut_damping = most / std::abs(rate);
  return out;
}

namespace {

constexpr int kHolds = 1, kForwards = 2, kBackwards = 3, kOpen = 4;

int slipping(double slip) { return slip > 0.0 ? kForwards : kBackwards; }

}  // namespace

void RateHold::start_states(const Sight& sight, double* states) const {
  const double slip = sight.coordinate.rate - aimed(sight);
  states[0] = slip == 0.0 ? kHolds : slipping(slip);
}

int RateHold::struck_regime(const Sight& sight, double rounding) const {
  if (sight.stand.regime == kOpen) return kOpen;
  const double slip = sight.coordinate.rate - aimed(sight);
  return std::abs(slip) <= rounding ? kHolds : slipping(slip);
}

RigidRow RateHold::row(const Sight& sight) const {
  const double slip = sight.coordinate.rate - aimed(sight);
  const int regime = sight.stand.regime == 0 ? kHolds : sight.stand.regime;
  const double pull = regime == kForwards ? -1.0 : regime == kBackwards ? 1.0 : sight.stand.force;
  const double bound = std::max(0.0, most(sight, pull));
  RigidRow out;
  out.next = sight.stand;
  out.slip = slip;
  out.is_closed = regime == kHolds;
  if (bound == 0.0) {
    if (regime != kOpen) out.next = {kOpen, 0.0};
    return out;
  }
  if (out.is_closed) {
    if (std::abs(sight.stand.force) > bound) {
      out.next = {slipping(-sight.stand.force), std::copysign(bound, sight.stand.force)};
    }
    return out;
  }
  if (regime == kOpen) {
    out.next = {slipping(slip), 0.0};
    return out;
  }
  const double direction = regime == kForwards ? 1.0 : -1.0;
  out.given = -direction * bound;
  if (direction * slip < 0.0) out.next = {kHolds, out.given};
  return out;
}

bool CoordinateServo::uses_signals() const {
  return (data_.position && data_.position->uses_signals()) ||
         (data_.speed && data_.speed->uses_signals()) || data_.limit.uses_signals() ||
         data_.power.uses_signals();
}

double CoordinateServo::law_rate(const Sight& sight) const {
  return data_.speed ? data_.speed->value(sight.t, sight.signals) : data_.position->rate(sight.t);
}

double CoordinateServo::aimed(const Sight& sight) const {
  if (!data_.position) return law_rate(sight);
  const double wanted = data_.position->value(sight.t, sight.signals);
  return law_rate(sight) + (wanted - sight.coordinate.value) / data_.return_time;
}

double CoordinateServo::aimed_acceleration(const Sight& sight) const {
  if (!data_.position) return data_.speed->rate(sight.t);
  const bool is_law = !data_.speed && !data_.position->formula;
  const double out = is_law ? data_.position->law.acceleration(sight.t) : 0.0;
  return out + (law_rate(sight) - sight.coordinate.rate) / data_.return_time;
}

double CoordinateServo::most(const Sight& sight, double force) const {
  const double rate = sight.coordinate.rate;
  const double limit = from_zero(data_.limit, sight);
  const double power = from_zero(data_.power, sight);
  if (force * rate <= 0.0 || power == HUGE_VAL) return limit;
  return std::min(limit, power / std::abs(rate));
}

}  // namespace buckens::loads
