// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/straighten.h"

#include "buckens/fem/solid/element.h"

namespace buckens::fem {

namespace {

NodeVectors positions_of(const ImportedMesh& mesh, const int* nodes) {
  NodeVectors out(3, 10);
  for (int k = 0; k < 10; ++k) out.col(k) = mesh.positions[static_cast<std::size_t>(nodes[k])];
  return out;
}

void straighten(ImportedMesh& mesh, const int* nodes) {
  const auto at = [&](int k) -> Eigen::Vector3d& {
    return mesh.positions[static_cast<std::size_t>(nodes[k])];
  };
  const auto& edges = solid_topology(SolidKind::tet10).edges;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    at(4 + static_cast<int>(k)) = 0.5 * (at(edges[k][0]) + at(edges[k][1]));
  }
}

}  // namespace

int straighten_inverted(ImportedMesh& mesh) {
  int count = 0;
  // An element with straight edges is valid, so each round leaves fewer that can fail.
  for (bool changed = true; changed;) {
    changed = false;
    for (const ImportedBlock& block : mesh.blocks) {
      if (block.kind != CellKind::tet10) continue;
      for (int e = 0; e < block.num_elements(); ++e) {
        const int* nodes = block.nodes.data() + static_cast<std::ptrdiff_t>(e) * 10;
        const NodeVectors x = positions_of(mesh, nodes);
        if (solid_least_volume(SolidKind::tet10, x) > 0.0 &&
            solid_least_node_volume(SolidKind::tet10, x) > 0.0) {
          continue;
        }
        straighten(mesh, nodes);
        if (positions_of(mesh, nodes) == x) continue;  // its corners are at fault
        ++count;
        changed = true;
      }
    }
  }
  return count;
}

}  // namespace buckens::fem
