// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::fem {

/// Corners of one face of a volume, counter-clockwise seen from outside; the fourth is −1 for
/// triangles.
using CellFace = std::array<int, 4>;

/// Number of corners, which come first among the nodes of every kind.
int num_corners(CellKind kind);

/// Number of corners of a face.
constexpr int num_corners(const CellFace& face) { return face[3] < 0 ? 3 : 4; }

/// Faces of a volume; of a surface, the surface itself; none for points and lines.
std::span<const CellFace> cell_faces(CellKind kind);

/// Edges of a kind as pairs of corners, in the order of its mid-side nodes.
std::span<const std::array<int, 2>> cell_edges(CellKind kind);

}  // namespace buckens::fem
