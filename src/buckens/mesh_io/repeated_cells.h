// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

/// The elements of a mesh in which version 2.2 of Gmsh's format has written an element once for
/// each group that it belongs to: each once, in all of its groups. The lowest number stays.
std::vector<TaggedCells> merged_cells(const TaggedMesh& mesh);

}  // namespace buckens::mesh_io
