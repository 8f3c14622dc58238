// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "buckens/fem/mesh/cell_mesh.h"
#include "buckens/fem/shell/section.h"
#include "buckens/fem/shell/spec.h"

namespace buckens::fem {

/// Names of nodes of a plate: corner_00, corner_10, corner_01, corner_11, edge_x0 … edge_y1 and
/// centre, those in the middle only where there is a node.
std::vector<std::string> plate_node_names(const std::array<int, 2>& divisions);

/// Adds the nodes and shells of a plate, its edges as node sets x0, x1, y0, y1, and its sides as
/// faces `top` (towards z) and `bottom`. The diagonal of triangles alternates from field to
/// field.
GeneratedMesh add_plate(Structure& structure, const PlateMeshSpec& spec,
                        const ShellSection& section);

}  // namespace buckens::fem
