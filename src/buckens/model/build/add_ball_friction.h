// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/loads/joint_law_spec.h"
#include "buckens/model/build/marker_finder.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// Sets the element of a load that is friction of a ball or of both bearings of a cross joint, and
/// what it acts on.
/// @return the loads that follow it: friction of a ball that sticks rigidly is a load for each
/// axis, and that of a cross without springs one for each arm
std::vector<Load> set_ball_friction(const loads::BallFrictionSpec& spec, MarkerFinder& find,
                                    Load& load, const SourceLocation& where);

}  // namespace buckens::model
