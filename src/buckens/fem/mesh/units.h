// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// Sentences on sizes, stiffnesses and densities that belong to no machine part, and which unit
/// would explain them.
/// @param mesh in SI units as they follow from what the user said
/// @param units_given whether the user said something
std::vector<std::string> unit_warnings(const ImportedMesh& mesh, const Eigen::AlignedBox3d& box,
                                       bool units_given);

}  // namespace buckens::fem
