// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// A sensor for the value of a signal.
/// @throws InputError if there is none of this name
std::unique_ptr<Sensor> make_signal_sensor(const model::BuiltModel& built,
                                           const model::SensorSpec& spec,
                                           const std::string& signal);

}  // namespace buckens::results
