// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/model/build/build_model.h"
#include "buckens/results/sensor.h"

namespace buckens::results {

/// Tensions in the spans of a cable, wraps around its pulleys, and slip over them.
/// @throws InputError if there is no such cable
std::unique_ptr<Sensor> make_cable_sensor(const model::BuiltModel& built,
                                          const model::SensorSpec& spec, const std::string& cable);

}  // namespace buckens::results
