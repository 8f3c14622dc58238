// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "buckens/mesh_io/step/walls.h"

namespace buckens::mesh_io {

/// Two triangles of a surface that cut each other or lie on each other, between which no
/// tetrahedron fits.
struct SurfaceCrossing {
  Eigen::Vector3d place;
  std::array<int, 2> faces{};  ///< numbers of the faces that they are on
};

/// All such pairs. Triangles in one plane that share no edge are not compared.
std::vector<SurfaceCrossing> surface_crossings(const PartMesh& mesh);

}  // namespace buckens::mesh_io
