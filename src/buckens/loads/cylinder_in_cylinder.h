// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/loads/overlap_cell.h"

namespace buckens::loads {

/// What is nearest to the curved side of a cylinder: normals n point away from its axis.
struct SideCell {
  double volume = 0, depth = 0;                      ///< as of an OverlapCell
  Eigen::Vector3d push = Eigen::Vector3d::Zero();    ///< integral of n [m³]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of n times the place along the axis [m⁴]
  double square = 0;                                 ///< of the square of that place [m⁵]
  double first = 0;                                  ///< of that place [m⁴]
};

/// What two cylinders have in common.
struct CylinderCells {
  std::array<OverlapCell, 2> ends;  ///< of the first: that along its axis, and the other
  SideCell side;
};

/// In axes of the first, its middle being the origin. Sections parallel to both axes are
/// polygons; sums over them and across them are by Gauss, along the first one's axis exact.
/// @return whether there is anything
bool find_cylinder_in_cylinder(const PlacedCylinder& first, const PlacedCylinder& second,
                               CylinderCells& cells);

}  // namespace buckens::loads
