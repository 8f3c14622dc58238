// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/pressure_load.h"

#include <utility>

namespace buckens::loads {

PressureLoad::PressureLoad(base::TimeLaw value, double area, const Eigen::Vector3d& force_B,
                           const Eigen::Vector3d& torque_B)
    : value_(std::move(value)), area_(area), force_B_(force_B), torque_B_(torque_B) {}

Action PressureLoad::evaluate(double t, const spatial::MarkerMotion& first,
                              const spatial::MarkerMotion& /*second*/) const {
  const double p = value_.value(t);
  Action action;
  action.on_first.force = first.R * (p * force_B_);
  action.on_first.torque = first.R * (p * torque_B_);
  action.along_pattern = p * area_;
  action.active_power = action.on_first.force.dot(first.v) + action.on_first.torque.dot(first.w);
  return action;
}

}  // namespace buckens::loads
