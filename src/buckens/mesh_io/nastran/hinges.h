// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"

namespace buckens::mesh_io {

/// Ties one node to another at the same position in all components except those released, by a
/// rigid link or by equations.
/// @param axes as columns @param released three translations and three rotations in these axes
void tie_nastran_nodes(int node, int follower, const Eigen::Matrix3d& axes,
                       const std::array<bool, 6>& released, const std::string& name, int line,
                       fem::ImportedMesh& mesh);

/// The end of a beam with pin flags: a separate node at the position of another, tied to it in all
/// components except those released.
/// @param axes of the beam as columns
/// @param released three translations and three rotations in these axes
/// @param name for the tie @return index of the new node
int add_nastran_hinge(int node, const Eigen::Matrix3d& axes, const std::array<bool, 6>& released,
                      const std::string& name, int line, NastranCoordinates& coordinates,
                      fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
