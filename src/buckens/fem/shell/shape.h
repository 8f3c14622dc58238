// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace buckens::fem {

/// Maximum number of nodes of a shell element.
inline constexpr int kMostShellNodes = 8;

/// One vector per node of a shell element, column by column.
using ShellVectors = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostShellNodes>;
/// Derivatives of the shape functions along two coordinates, node by node.
using ShellSlope = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMostShellNodes>;

/// Shells have 3, 4, 6 or 8 nodes: corners counter-clockwise, then the nodes on the sides, starting
/// between corners 0 and 1.
constexpr bool is_shell_triangle(Eigen::Index num_nodes) {
  return num_nodes == 3 || num_nodes == 6;
}
constexpr bool is_shell_quadratic(Eigen::Index num_nodes) { return num_nodes > 4; }
constexpr Eigen::Index num_shell_corners(Eigen::Index num_nodes) {
  return is_shell_triangle(num_nodes) ? 3 : 4;
}

/// Shape functions of the nodes, and their derivatives along the natural coordinates: [−1, 1]² for
/// quadrilaterals, r, s ≥ 0 with r + s ≤ 1 for triangles. Eight nodes: serendipity functions.
struct ShellShape {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostShellNodes, 1> N;
  ShellSlope slope;
};
ShellShape shell_shape(Eigen::Index num_nodes, double r, double s);

/// Natural coordinates of the nodes.
std::span<const std::array<double, 2>> shell_node_places(Eigen::Index num_nodes);
/// The nodes in order around the element.
std::span<const int> shell_rim(Eigen::Index num_nodes);
/// The element divided into pieces of three (fourth −1) or four nodes for drawing.
std::span<const std::array<int, 4>> shell_pieces(Eigen::Index num_nodes);

struct ShellRulePoint {
  double r = 0, s = 0, weight = 0;
};
/// Quadrilateral: n×n Gauss points. Triangle: degree 2n − 1 by collapsing a square.
std::vector<ShellRulePoint> shell_rule(bool is_triangle, int n);
/// Six points of degree 4 with positive weights (Strang, Fix).
std::vector<ShellRulePoint> triangle_rule_of_degree_4();
/// Points that integrate ∫ N_i N_j dA of flat elements exactly.
std::vector<ShellRulePoint> shell_mass_rule(Eigen::Index num_nodes);

}  // namespace buckens::fem
