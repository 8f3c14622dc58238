// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"

namespace buckens::dynamics {

/// Residuals g, ġ, ∂g/∂t of all joints without their derivatives: `out.rows` stays as it is.
///
/// With multipliers, the forces Gᵀλ are added as well, joint by joint: the rows of a joint act on
/// its two markers together, so that a marker's wrench goes to its body once. The same as
/// evaluate_constraints() and add_joint_forces(), at a third of the cost; allocates nothing once
/// `out` has its size.
/// @param lambda,forces both or neither
void evaluate_joints(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     Constraints& out, const linalg::Vector* lambda = nullptr,
                     Forces* forces = nullptr);

}  // namespace buckens::dynamics
