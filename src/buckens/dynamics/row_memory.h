// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/law_ends.h"
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// Memory of joint coordinates and force laws at the start of a motion: no turns yet, and laws at
/// rest.
/// @param released RowMemory::released: rows of these joints know nothing yet
model::RowMemory start_memory(const model::Model& model, const std::vector<BodyMotion>& motions,
                              const std::vector<char>& released = {});

/// Lets rows of joints that remember a sign of their multiplier see those of the start.
/// @return whether they remember something else now
bool follow_reactions(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                      const linalg::Vector& lambda, model::RowMemory& memory);

/// What joint rows are to know in a static analysis: no turns, and the signs of these multipliers.
model::RowMemory memory_at_rest(const model::Model& model, const std::vector<BodyMotion>& motions,
                                double t, const linalg::Vector& lambda);

/// What they remember at the end of a step.
/// @param motions at its end, @param around with the memory at its start
/// @param out neither of the two; its buffers are reused
/// @param ends null, or what was found where laws were evaluated at these motions
/// @throws StepTooLong if turns cannot be counted
void advance_memory(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                    const Circumstances& around, model::RowMemory& out,
                    const LawEnds* ends = nullptr);

}  // namespace buckens::dynamics
