// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Force or torque of a spring-damper, torsional spring or bushing, tension positive.
/// @throws InputError if there is none of this name, or it has no force (torque)
std::unique_ptr<Sensor> make_spring_sensor(const model::BuiltModel& built,
                                           const model::SensorSpec& spec, const std::string& spring,
                                           bool torque);

}  // namespace buckens::results
