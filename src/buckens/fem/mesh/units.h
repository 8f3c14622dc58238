// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// Sentences on sizes, stiffnesses and densities that no machine part has, and the unit that would
/// explain them.
/// @param mesh in SI units, converted as the user stated
/// @param units_given whether the user stated units
std::vector<std::string> unit_warnings(const ImportedMesh& mesh, const Eigen::AlignedBox3d& box,
                                       bool units_given);

}  // namespace buckens::fem
