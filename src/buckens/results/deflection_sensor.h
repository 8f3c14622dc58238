// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// @param markers the observed one only (relative to the body frame); followed by one more, the
/// reference; or by two more, the ends of a chord
/// @throws ModelError if the reference marker has no rotation
std::unique_ptr<Sensor> make_deflection_sensor(const model::BuiltModel& built,
                                               const model::SensorSpec& spec,
                                               const std::vector<model::MarkerId>& markers);

}  // namespace buckens::results
