// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "buckens/joints/gear_mesh.h"
#include "buckens/joints/joint.h"
#include "buckens/joints/joint_coordinate.h"

namespace buckens::joints {

/// The meshing row of a gear or a belt as placed.
/// @param axis_F unit vector @throws ModelError as GearMesh
std::shared_ptr<const GearMesh> placed_gear(JointType type, const Eigen::Vector3d& axis_F,
                                            const Placement& placement);

/// That of a rack. @throws ModelError if it does not run across the axis of its pinion
std::shared_ptr<const RackMesh> placed_rack(const Eigen::Vector3d& axis_F,
                                            const Placement& placement);

/// How far either flank of rigid teeth with play is from the other gear, see FlankGap: that which
/// pushes where the residual of the row is positive, then the other one.
struct FlankGaps {
  std::array<JointCoordinate, 2> gaps;
  double play = 0;    ///< j, along the line of action [m]
  double period = 0;  ///< along the line of action, after which teeth stand as before [m]
};
/// @param type gear or rack, @param backlash on the pitch circle [m]
/// @throws ModelError as make_rows(), which is to be asked first for what is wrong in a plane; if
///         the play leaves no teeth
FlankGaps make_flank_gaps(JointType type, const Placement& placement, double backlash);

}  // namespace buckens::joints
