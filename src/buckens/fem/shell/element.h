// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/fem/shell/block.h"

namespace buckens::fem {

/// Square in the nodal variables of a shell element, six per node, node by node.
using ShellMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6 * kMostShellNodes,
                                  6 * kMostShellNodes>;
/// A row of the nodal variables.
using ShellRow = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 6 * kMostShellNodes>;
/// Strain of the middle surface ε_x, ε_y, γ_xy, curvature κ_x, κ_y, κ_xy, transverse shear γ_xz,
/// γ_yz as rows over the nodal variables.
using ShellStrain = Eigen::Matrix<double, 8, Eigen::Dynamic, 0, 8, 6 * kMostShellNodes>;

/// One element with everything its integrals need.
struct ShellElement {
  ShellVectors nodes;      ///< positions of the nodes [m]
  ShellVectors directors;  ///< unit vectors
  double offset = 0;       ///< of the middle surface along the directors [m]
  const ShellSection* section = nullptr;
  const ShellStiffness* stiffness = nullptr;

  bool is_triangle() const { return is_shell_triangle(nodes.cols()); }
  bool is_quadratic() const { return is_shell_quadratic(nodes.cols()); }
  Eigen::Index num_variables() const { return 6 * nodes.cols(); }
  /// Positions of the middle surface at the nodes.
  ShellVectors middle() const { return nodes + offset * directors; }
};

ShellElement shell_element(const ShellBlock& block, const std::vector<Node>& nodes, int element);

/// Axes of the shell at a point: columns x, y, normal.
/// @param tangents ∂X/∂r, ∂X/∂s
Eigen::Matrix3d shell_axes(const ShellElement& element,
                           const Eigen::Matrix<double, 3, 2>& tangents);

/// Area per natural coordinates at a point of the middle surface [m²].
double shell_area(const ShellElement& element, const ShellShape& shape);

/// ∫ strain energy, six variables per node. With straight sides, quadrilateral: MITC4 (Dvorkin,
/// Bathe, 1984) with incompatible membrane modes and the drilling rotation tied to the rotation of
/// the surface (Hughes, Brezzi, 1989). Triangle: MITC3+ (Lee, Lee, Bathe, 2014) with Felippa's
/// optimal membrane triangle with drilling rotations (2003). With nodes on the sides: see
/// quadratic_strain().
ShellMatrix shell_stiffness_matrix(const ShellElement& element);

/// Strains at the centre, and the axes in which they are given.
struct ShellStrainRows {
  ShellStrain rows;
  Eigen::Matrix3d axes;
};
ShellStrainRows shell_centre_strain(const ShellElement& element);
/// The same at the nodes, one after the other.
std::vector<ShellStrainRows> shell_corner_strains(const ShellElement& element);
/// The axes alone.
std::vector<Eigen::Matrix3d> shell_corner_axes(const ShellElement& element);

/// ∫ (ρ h³/12) (drilling rotation relative to that of the surface)² dA: inertia of spurious
/// rotations about the normal, none for rigid motion.
ShellMatrix shell_drilling_inertia(const ShellElement& element);

}  // namespace buckens::fem
