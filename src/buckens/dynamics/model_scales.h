// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// Per row of λ what its residual is measured against: the model's length for rows that are
/// lengths, 1 for the others, which are sines of angles.
linalg::Vector row_lengths(const model::Model& model);

/// The length whose rounding is that of positions: the model's own, or the distance from the origin
/// of the farthest body where that is more.
double rounding_length(const model::Model& model, const std::vector<spatial::Pose>& X_WB);
double rounding_length(const model::Model& model, const std::vector<BodyMotion>& motions);

/// The shortest lever with which a joint turns a body, (ρ² + z²)/z with the radius of gyration ρ
/// and the distance z of the joint from the mass centre [m], at most the model's length. What opens
/// a joint by a length turns the body by that length over this lever.
double shortest_lever(const model::Model& model);

}  // namespace buckens::dynamics
