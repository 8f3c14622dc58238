// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/joints/joint.h"
#include "buckens/loads/contact_pair.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::model {

/// The places in which a pair can touch without a stiffness: docs/theory/25-contact.md §4.
/// @param placed both markers, @param normal of the plane of planar models, world axes
std::vector<spatial::RigidTouch> rigid_touches(const loads::ContactPair& pair,
                                               const joints::Placement& placed,
                                               const std::optional<Eigen::Vector3d>& normal);

}  // namespace buckens::model
