// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace buckens::fem {

/// Shapes of elements in mesh files, named by their number of nodes. Corners come first, then the
/// mid-side nodes in the order of Abaqus (C3D20, C3D15, C3D10), which is also that of VTK. Gmsh,
/// Nastran and universal files order some kinds differently; their readers reorder them.
enum class CellKind {
  point1,
  line2,
  line3,
  tri3,
  tri6,
  quad4,
  quad8,
  tet4,
  tet10,
  pyramid5,
  wedge6,
  wedge15,
  hex8,
  hex20,
};

constexpr std::array<const char*, 14> choice_names(CellKind) {
  return {"point1", "line2", "line3",    "tri3",   "tri6",    "quad4", "quad8",
          "tet4",   "tet10", "pyramid5", "wedge6", "wedge15", "hex8",  "hex20"};
}

constexpr const char* name_of(CellKind kind) {
  return choice_names(kind)[static_cast<std::size_t>(kind)];
}

constexpr int num_nodes(CellKind kind) {
  constexpr std::array<int, 14> counts = {1, 2, 3, 3, 6, 4, 8, 4, 10, 5, 6, 15, 8, 20};
  return counts[static_cast<std::size_t>(kind)];
}

/// 0 for points, 1 for lines, 2 for surfaces, 3 for volumes.
constexpr int dimension_of(CellKind kind) {
  if (kind == CellKind::point1) return 0;
  if (kind <= CellKind::line3) return 1;
  return kind <= CellKind::quad8 ? 2 : 3;
}

}  // namespace buckens::fem
