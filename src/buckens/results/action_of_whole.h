// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/travel.h"
#include "buckens/results/observation.h"

namespace buckens::results {

/// What a load of the model file does between its markers. Friction of a ball that sticks
/// rigidly has a load for each axis, that of a cross without springs one for each arm.
/// @param load index into Model::loads, of the first of several
loads::Action action_of_whole(const Observation& now, std::size_t load,
                              const dynamics::LoadEnds& ends);

}  // namespace buckens::results
