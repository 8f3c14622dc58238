// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/abaqus/names.h"

namespace buckens::mesh_io {

/// Ties slave nodes to the faces of master surfaces: *TIE. Each node follows the point of the
/// master nearest to it by the shape functions there; one away from the surface keeps its distance
/// and rotates with the face, so that rigid motion causes no strain for any gap. The relations
/// become equations of the mesh.
///
/// Nodes farther away than the position tolerance (by default 5 % of the mean size of a master
/// face, as in Abaqus) stay free. Rotations are tied where slave and master both have them.
/// @param turns per node whether it has rotations
void add_abaqus_ties(const AbaqusLines& lines, AbaqusNames& names, const std::vector<bool>& turns,
                     fem::ImportedMesh& out);

}  // namespace buckens::mesh_io
