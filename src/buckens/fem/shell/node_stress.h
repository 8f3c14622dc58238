// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/fe_model.h"
#include "buckens/fem/shell/block.h"
#include "buckens/fem/solid/strains.h"

namespace buckens::fem {

/// A node with a group of the shells that meet there, over which stresses may be averaged.
struct ShellPlace {
  int node = 0;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns x, y, normal in model axes
};

/// Stresses on the surfaces of shells at nodes.
///
/// Strains are taken at the nodes of the elements and averaged over neighbours with equal weights.
/// Two elements are neighbours if they share a side with no third shell, have the same section,
/// their normals there differ by less than 25°, and, with layers that have a direction, their x
/// axes by less than 10°. Where plates of different thickness, branches or edges meet at a node, it
/// has a place for each side. Second order in the element size inside a smooth mesh, first order at
/// its boundary. Theory: docs/theory/18-stresses.md.
class ShellNodeStresses {
 public:
  /// @param nodes at which stresses are wanted, each once
  ShellNodeStresses(const FeModel& fe, const std::vector<int>& nodes);

  const std::vector<ShellPlace>& places() const { return places_; }
  /// Place of a node for a shell, numbered among the shells; −1 if it is not wanted.
  int place_of(int node, int shell) const;

  /// Rows 6 p + (0…5) over the nodal variables: ε_x, ε_y, γ_xy of the middle surface, κ_x, κ_y,
  /// κ_xy at place p in its axes.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows() const { return rows_; }

  struct Surface {
    TensorColumns strain, stress;  ///< of the side the normal points to, model axes
    Eigen::VectorXd mises;         ///< the larger of both sides [Pa]
  };
  /// @param strains 6 × places, of rows()
  Surface surface(const Eigen::Ref<const TensorColumns>& strains) const;

 private:
  struct Side {
    Eigen::Matrix3d elasticity;  // σ_x, σ_y, τ_xy per strains
    double z = 0;
    Eigen::RowVector3d thinning;  // ε_z per stresses
  };
  struct Sides {
    Side top, bottom;
  };
  class Grouping;

  static Side side_of(const ShellSection& section, bool is_top);

  std::vector<ShellPlace> places_;
  std::vector<std::size_t> sections_;  // of each place, into sides_
  std::vector<Sides> sides_;           // of each different section
  // For each shell, node by node, −1 after the last.
  std::vector<std::array<int, kMostShellNodes>> corner_place_, corner_node_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
};

}  // namespace buckens::fem
