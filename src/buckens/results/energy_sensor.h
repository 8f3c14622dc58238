// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Energies of the whole model, and parts of its energy account.
/// @throws InputError if nothing of this name has such a part
std::unique_ptr<Sensor> make_energy_sensor(const model::BuiltModel& built,
                                           const model::SensorSpec& spec,
                                           const model::EnergySensor& sensor);

}  // namespace buckens::results
