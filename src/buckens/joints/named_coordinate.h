// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "buckens/base/coordinate_choice.h"
#include "buckens/joints/joint.h"
#include "buckens/joints/joint_coordinate.h"

namespace buckens::joints {

/// A coordinate that a joint offers to laws, drives, sensors and signals.
struct NamedCoordinate {
  base::CoordinateChoice which = base::CoordinateChoice::displacement;
  JointCoordinate law;
};

/// The coordinates of a joint; in planar models only those within the plane.
/// @param names as the joint's spec lists them, @param rows of the joint
/// @throws ModelError if an axis has no direction
std::vector<NamedCoordinate> make_coordinates(JointType type,
                                              std::span<const base::CoordinateChoice> names,
                                              const Placement& placement,
                                              const std::vector<ConstraintRow>& rows);

}  // namespace buckens::joints
