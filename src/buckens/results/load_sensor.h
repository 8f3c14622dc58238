// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Resultant of a load of the model file, which may occur in the model once per body.
/// @param about_and_in markers of the sensor: the torque's point (torque sensors only), then the
///        axes of the components, if there are any
/// @throws InputError if the load is a spring, whose resultant on all bodies is zero
std::unique_ptr<Sensor> make_load_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& load,
                                         bool torque,
                                         const std::vector<model::MarkerId>& about_and_in);

}  // namespace buckens::results
