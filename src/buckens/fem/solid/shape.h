// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/solid/form.h"

namespace buckens::fem {

/// Maximum number of nodes of a solid element.
inline constexpr int kMostSolidNodes = 20;

/// One number per node of a solid element.
using NodeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostSolidNodes, 1>;
/// One vector per node, column by column.
using NodeVectors = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostSolidNodes>;

/// Shape functions at a point of the natural coordinates.
struct SolidShape {
  NodeValues N;
  NodeVectors slope;  ///< ∂N/∂ξ
};

/// One face of a solid element: the nodes on it.
struct SolidFace {
  std::vector<int> corners;    ///< three or four, counter-clockwise seen from outside
  std::vector<int> mid_sides;  ///< entry k: between corners k and k + 1; empty if linear

  /// Corners, then mid-side nodes.
  std::vector<int> nodes() const;
};

/// Common to all elements of a kind.
struct SolidTopology {
  int num_nodes = 0;
  int num_corners = 0;
  /// Natural coordinates of the nodes: [−1, 1]³ for hexahedra (lower face ζ = −1 counter-clockwise
  /// seen from above, then the upper face); ξ, η, ζ ≥ 0 with sum ≤ 1 for tetrahedra (origin, then
  /// the ends of the axes); ξ, η ≥ 0 with sum ≤ 1 and ζ in [−1, 1] for wedges (lower triangle, then
  /// the upper one); base [−1, 1]² at ζ = 0 counter-clockwise seen from above and apex (0, 0, 1)
  /// for pyramids.
  NodeVectors natural;
  Eigen::Vector3d centre;
  std::vector<std::array<int, 2>> edges;  ///< corners of each edge, in the order of its mid node
  /// Hexahedra: x0, x1, y0, y1, z0, z1 of the natural coordinates. Tetrahedra: face k is opposite
  /// corner k. Wedges: lower, upper triangle, then the sides on edges 0, 1, 2. Pyramids: sides on
  /// base edges 0…3, then the base.
  std::vector<SolidFace> faces;
  /// The faces divided into pieces of three (fourth −1) or four nodes for drawing; those of a face
  /// are consecutive.
  std::vector<std::array<int, 4>> pieces;

  bool is_hexahedron() const { return num_corners == 8; }
  bool is_tetrahedron() const { return num_corners == 4; }
  bool is_wedge() const { return num_corners == 6; }
};

const SolidTopology& solid_topology(SolidKind kind);

/// Shape functions and their derivatives at natural coordinates.
SolidShape solid_shape(SolidKind kind, const Eigen::Vector3d& natural);

}  // namespace buckens::fem
