// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/step/walls.h"

namespace buckens::mesh_io {

/// Tetrahedra whose corners lie in one plane but for rounding, as places in the list of all.
std::vector<std::size_t> tetrahedra_without_volume(const PartMesh& mesh);

/// Lets Gmsh swap edges and move nodes where its mesh has such tetrahedra.
/// @return what is left of them; empty: none
std::string mend_flat_elements(GmshLibrary& gmsh, double metre);

}  // namespace buckens::mesh_io
