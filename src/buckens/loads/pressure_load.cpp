// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/pressure_load.h"

#include <utility>

namespace buckens::loads {

PressureLoad::PressureLoad(base::TimeLaw value, double area, const Eigen::Vector3d& force_B,
                           const Eigen::Vector3d& torque_B, SignalFactor factor)
    : value_(std::move(value)),
      area_(area),
      force_B_(force_B),
      torque_B_(torque_B),
      factor_(factor) {}

Action PressureLoad::evaluate(double t, const spatial::MarkerMotion& first,
                              const spatial::MarkerMotion& /*second*/) const {
  return press(value_.value(t), first);
}

Action PressureLoad::respond(const Sight& sight) const {
  return press(factor_.value(sight) * value_.value(sight.t), sight.first);
}

Action PressureLoad::press(double p, const spatial::MarkerMotion& first) const {
  Action action;
  action.on_first.force = first.R * (p * force_B_);
  action.on_first.torque = first.R * (p * torque_B_);
  action.along_pattern = p * area_;
  action.active_power = action.on_first.force.dot(first.v) + action.on_first.torque.dot(first.w);
  return action;
}

}  // namespace buckens::loads
