// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/signal.h"

namespace buckens::dynamics {

/// Value of a sensor that follows from motion and time at one instant, as the sensor of the same
/// name records it. Theory: docs/theory/24-control.md §3.
double read_motion(const model::Model& model, const model::MotionReading& reading,
                   const std::vector<BodyMotion>& motions, double t, const Circumstances& around);

}  // namespace buckens::dynamics
