// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/build_model.h"

namespace buckens::model {

/// Signals of sensors whose value follows from the motion at the same instant become such; the
/// others stay as they are, blocks that take their value at the ends of steps. To be called when
/// sensors and loads are there.
/// @throws InputError naming the signal if there is no such sensor, or it records a signal itself
void read_within_steps(BuiltModel& built);

}  // namespace buckens::model
