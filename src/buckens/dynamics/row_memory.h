// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// Memory of joint coordinates and force laws at the start of a motion: no turns yet, and laws at
/// rest.
model::RowMemory start_memory(const model::Model& model, const std::vector<BodyMotion>& motions);

/// Their memory at the end of a step.
/// @param motions at its end, @param around with the memory at its start
/// @param out neither of the two; its buffers are reused
void advance_memory(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                    const Circumstances& around, model::RowMemory& out);

}  // namespace buckens::dynamics
