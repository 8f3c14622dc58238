// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/vtu/file.h"

namespace buckens::mesh_io {

/// The mesh as a grid of VTK: numbers of nodes, elements and properties, and for every set of nodes
/// or elements 1 for its members and 0 for others.
VtuGrid vtu_grid(const fem::ImportedMesh& mesh);

/// What vtu_grid() leaves out.
std::vector<fem::ImportNote> losses_in_vtu(const fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
