// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Tensions and slip of an elastic belt.
/// @throws InputError if there is no such belt
std::unique_ptr<Sensor> make_belt_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& belt);

}  // namespace buckens::results
