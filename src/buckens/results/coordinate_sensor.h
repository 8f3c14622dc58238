// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Angle or displacement of a joint, and its rate.
/// @param coordinate index into Model::coordinates
std::unique_ptr<Sensor> make_coordinate_sensor(const model::BuiltModel& built,
                                               const model::SensorSpec& spec,
                                               std::size_t coordinate);

}  // namespace buckens::results
