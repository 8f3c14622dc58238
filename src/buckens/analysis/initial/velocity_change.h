// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Says which bodies do not start with the velocities that the model file gives them, because the
/// joints do not allow these. A sentence per body; bodies without given velocities are not judged.
/// @param given velocities as in the model file, @param projected those of the start
std::vector<std::string> describe_velocity_changes(const model::BuiltModel& built,
                                                   const model::State& given,
                                                   const model::State& projected);

}  // namespace buckens::analysis
