// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Reports bodies that do not start with the velocities given in the model file, because the joints
/// do not allow them. A sentence per body; bodies without given velocities are not checked.
/// @param given velocities as in the model file, @param projected those of the start
std::vector<std::string> describe_velocity_changes(const model::BuiltModel& built,
                                                   const model::State& given,
                                                   const model::State& projected);

}  // namespace buckens::analysis
