// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/fem/mesh_spec.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// A node of a generated mesh that has a name, numbered from the first node of the mesh.
struct NamedNode {
  std::string name;
  int node = 0;
};

/// Names of nodes of a mesh, known before it is made: see named_places(const Box&).
std::vector<NamedNode> named_nodes(const MeshSpec& spec);

/// Why a mesh cannot be made although each of its numbers is fine; empty if it can.
std::optional<std::string> size_problem(const MeshSpec& spec);

/// Adds the nodes and elements of a mesh.
/// @return number of its first node; the others follow
/// @throws ModelError if a size or a division is not positive
int add_mesh(Structure& structure, const MeshSpec& spec, const Material& material);

}  // namespace buckens::fem
