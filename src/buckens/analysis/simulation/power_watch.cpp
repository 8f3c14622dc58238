// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/power_watch.h"

#include <algorithm>
#include <cmath>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/coordinate_motor.h"

namespace buckens::analysis {

namespace {

// Of what its power gives within the longest step, this share more is let pass in any one step. In
// a run from rest, steps of equal length follow the root of the time; the second of them, from 1 to
// √2, does (1 + √2)²/(4 √2) = 1.03 of its work by the trapezoidal rule, and all others less.
constexpr double kAllowed = 0.05;

double from_zero(const base::SignalLaw& law, const model::State& state) {
  return std::max(0.0, law.value(state.t, state.memory.signals));
}

/// A motor at one end of a step.
struct End {
  double force = 0, rate = 0;
};

/// The part of a step in which a motor drives: its length and its way. A rate that changes its sign
/// is taken as linear; the motor brakes on one side of zero.
struct Driving {
  double time = 0, way = 0;
};

Driving driving(const End& first, const End& last, double h, double way) {
  const double mean = 0.5 * (first.force + last.force);
  if (first.rate * last.rate >= 0.0) {
    // By what the method has carried along, the way may be far from that of the rates, even zero.
    const double of_rates = 0.5 * h * (first.rate + last.rate);
    return {h, std::abs(of_rates) > std::abs(way) ? of_rates : way};
  }
  const double rate = mean * last.rate > 0.0 ? last.rate : first.rate;
  const double time = h * rate / (rate == last.rate ? rate - first.rate : rate - last.rate);
  return {time, 0.5 * time * rate};
}

}  // namespace

PowerWatch::PowerWatch(const model::Model& model, bool carries) : model_(model), carries_(carries) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const loads::ForceElement* element = model.loads[k].element.get();
    const base::SignalLaw* power = nullptr;
    if (const auto* motor = dynamic_cast<const loads::CoordinateMotor*>(element)) {
      power = &motor->power();
    } else if (const auto* servo = dynamic_cast<const loads::CoordinateServo*>(element)) {
      power = &servo->power();
    }
    if (power != nullptr && !power->is_number(HUGE_VAL)) motors_.push_back({k, power});
  }
}

bool PowerWatch::exceeds(const model::State& before, const model::State& after,
                         double longest) const {
  if (motors_.empty() || !carries_) return false;
  const auto first = dynamics::motions_of(model_, before);
  const auto last = dynamics::motions_of(model_, after);
  const auto look = [&](std::size_t k, const model::State& state, const auto& motions) -> End {
    const model::Load& load = model_.loads[k];
    const model::RowMemory* memory = &state.memory;
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, memory);
    const auto around = dynamics::circumstances_of(state);
    const auto c = static_cast<std::size_t>(load.coordinate);
    return {dynamics::action_of(model_, k, state.t, around, ends).along_coordinate,
            dynamics::coordinate_motion(model_, c, state.t, memory, motions).rate};
  };
  return std::any_of(motors_.begin(), motors_.end(), [&](const Motor& motor) {
    const double most = std::max(from_zero(*motor.power, before), from_zero(*motor.power, after));
    const auto c = static_cast<std::size_t>(model_.loads[motor.load].coordinate);
    const double way =
        spatial::difference(before.memory.coordinates[c], after.memory.coordinates[c]);
    const End start = look(motor.load, before, first), end = look(motor.load, after, last);
    const Driving part = driving(start, end, after.t - before.t, way);
    const double work = 0.5 * (start.force + end.force) * part.way;
    return most > 0.0 && work > most * (part.time + kAllowed * longest);
  });
}

}  // namespace buckens::analysis
