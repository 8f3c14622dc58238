// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Force and deflection of the teeth of an elastic gear; of rigid teeth with play their force and
/// where they are within it.
/// @throws InputError if there are no such teeth
std::unique_ptr<Sensor> make_gear_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& gear);

}  // namespace buckens::results
