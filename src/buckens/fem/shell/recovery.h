// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/fem/fe_model.h"
#include "buckens/fem/shell/section.h"

namespace buckens::fem {

/// Position of a stress in a shell: the bottom (0), middle (½) or top (1) of one of its layers.
struct ShellLevel {
  int layer = 0;
  double height = 0.5;
};

/// Forces, moments and stresses of all shells at their centres, in the axes of each shell.
class ShellRecovery {
 public:
  explicit ShellRecovery(const FeModel& fe);

  int num_elements() const { return static_cast<int>(sections_.size()); }
  /// Columns x, y, normal in model axes.
  const Eigen::Matrix3d& axes(int element) const {
    return axes_[static_cast<std::size_t>(element)];
  }
  const ShellSection& section(int element) const {
    return sections_[static_cast<std::size_t>(element)];
  }

  /// @param d nodal variables
  /// @return 8×(number of elements): ε_x, ε_y, γ_xy of the middle surface, κ_x, κ_y, κ_xy [1/m],
  ///         γ_xz, γ_yz. Cost: one sparse product.
  linalg::Matrix strains(const linalg::Vector& d) const;
  /// N_x, N_y, N_xy [N/m], M_x, M_y, M_xy [N], Q_x, Q_y [N/m] from strains(). M_x > 0 stretches the
  /// side the normal points to.
  linalg::Matrix resultants(const linalg::Matrix& strains) const;
  /// σ_x, σ_y, τ_xy of one element at a given level, in the axes of the shell [Pa].
  Eigen::Vector3d stress(const linalg::Matrix& strains, int element, const ShellLevel& level) const;

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
  std::vector<Eigen::Matrix3d> axes_;
  std::vector<ShellSection> sections_;
  std::vector<ShellStiffness> stiffness_;
};

}  // namespace buckens::fem
