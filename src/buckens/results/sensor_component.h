// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "buckens/model/signal.h"
#include "buckens/results/sensor.h"

namespace buckens::results {

/// Place of one value among those that a sensor appends.
/// @param signal that reads it, with Signal::held
/// @throws InputError naming the components if none or another one is given
std::size_t find_component(const Sensor& sensor, const model::Signal& signal);

}  // namespace buckens::results
