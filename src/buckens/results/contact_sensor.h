// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/results/sensor.h"

namespace buckens::results {

/// Normal force, friction force and gap of a contact, elastic or rigid.
/// @throws InputError if there is no such contact
std::unique_ptr<Sensor> make_contact_sensor(const model::BuiltModel& built,
                                            const model::SensorSpec& spec,
                                            const std::string& contact);

}  // namespace buckens::results
