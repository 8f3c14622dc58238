// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::stepping {

/// Lets rigid rows follow impacts that have changed the rates of their coordinates: friction,
/// brakes and motors slide as their coordinates now do. Otherwise rows that had held would be
/// closed again, by impulses that they do not have.
/// @param before,after motions right before and after the impacts, @param around of the step
/// @param memory after the step, its rigid rows as before the impacts
void follow_struck_rows(const model::Model& model, const std::vector<dynamics::BodyMotion>& before,
                        const std::vector<dynamics::BodyMotion>& after, double t,
                        const dynamics::Circumstances& around, model::RowMemory& memory);

}  // namespace buckens::stepping
