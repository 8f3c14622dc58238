// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/fem/mesh/cell_mesh.h"
#include "buckens/fem/mesh/spec.h"

namespace buckens::fem {

/// Names of nodes of a mesh, known before it is generated: see named_places(const Box&) and
/// cylinder_cells().
std::vector<std::string> named_nodes(const MeshSpec& spec);

/// Why a mesh cannot be generated although each number by itself is valid; empty if it can.
std::optional<std::string> size_problem(const MeshSpec& spec);

/// Adds the nodes, elements and named faces of a mesh of solids; add_plate() makes plates.
/// @throws ModelError as box_cells() and cylinder_cells()
GeneratedMesh add_mesh(Structure& structure, const MeshSpec& spec, const Material& material);

}  // namespace buckens::fem
