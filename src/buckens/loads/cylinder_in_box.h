// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/loads/overlap_cell.h"

namespace buckens::loads {

/// Of each face of a box, twice the number of its axis, and one more on the negative side.
using BoxCells = std::array<OverlapCell, 6>;

/// What a cylinder has in common with a box, in axes of the box. Sections across the cylinder are
/// exact, sums along it are by Gauss between all places where sections change their form.
/// @param half of the box [m] @return whether there is anything
bool find_cylinder_in_box(const Eigen::Vector3d& half, const PlacedCylinder& cylinder,
                          BoxCells& cells);

}  // namespace buckens::loads
