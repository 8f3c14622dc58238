// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// How the nodes of a mesh are connected.
struct MeshConnection {
  int pieces = 0;               ///< parts that no element, link, spring or equation connects
  std::vector<int> free_nodes;  ///< that nothing uses
  int variables = 0;            ///< of used nodes: six at nodes of shells or beams, else three
};

MeshConnection connect(const ImportedMesh& mesh);

/// Pairs of used nodes closer together than 1e-6 of the size of the mesh, the lower number
/// first.
std::vector<std::pair<int, int>> coincident_nodes(const ImportedMesh& mesh);

}  // namespace buckens::fem
