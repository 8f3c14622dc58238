// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Acceleration of the coordinate of a load by those of the frames alone [m/s²], [rad/s²].
/// Vibrations that a step does not resolve have turned many times by its end.
/// @param row of the coordinate, @param state with the accelerations
double frame_acceleration(const model::Model& model, const model::Load& load,
                          const dynamics::SystemRow& row,
                          const std::vector<dynamics::BodyMotion>& motions,
                          const model::State& state);

}  // namespace buckens::analysis
