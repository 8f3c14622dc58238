// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/sparse_ldlt.h"
#include "buckens/stepping/cone_newton.h"

namespace buckens::stepping {

/// The impulses within all cones that minimise ½ PᵀDP − bᵀP:
///
///     w = D P − b,   |P_t| ≤ μ P_n,   w_n ≥ μ |w_t|,   Pᵀw = 0
///
/// (Anitescu, Tasora: An iterative approach for cone complementarity problems for nonsmooth
/// dynamics, 2010). This equals (I1) and (I2) except for sliding places, which separate at μ |w_t|.
/// The problem is convex, so a solution exists wherever some velocities satisfy w_n ≥ μ |w_t|. An
/// interior-point method finds it: each round moves along Newton's direction for a smaller Pᵀw, in
/// the scaling of Nesterov and Todd, as far as the cones admit.
class ConeProgram {
 public:
  /// @param D of all rows, positive semidefinite
  ConeProgram(const linalg::SparseMatrix& D, const std::vector<ConeRows>& places);

  /// @param P to about nine digits of the rates @return whether there is a solution
  bool solve(const linalg::Vector& b, linalg::Vector& P);

 private:
  /// Rows of one place in the variables of this problem.
  struct Block {
    Eigen::Index first = 0, size = 1;
    linalg::Matrix scaling, inverse;  ///< W with W s = W⁻¹ x
  };
  /// x: impulses, s: rates, scaled such that all cones are |x_t| ≤ x_n; and Newton's directions.
  struct Iterate {
    linalg::Vector x, s, dx, ds;
  };

  void scale(const Iterate& now);
  bool factorise();
  /// @param wanted W⁻¹ dx + W ds, @param open Q x + c − s
  void find_direction(const linalg::Vector& wanted, const linalg::Vector& open, Iterate& now);
  /// λ \ (σ μ e − λ∘λ − W⁻¹dx ∘ W ds) of each block.
  linalg::Vector corrected(const Iterate& now, double centre) const;
  double longest_step(const Iterate& now) const;

  double answer_;                   // largest of D
  std::vector<Eigen::Index> rows_;  // of D, in the order of the blocks
  linalg::Vector scales_;           // impulses per x
  std::vector<Block> blocks_;
  linalg::SparseMatrix Q_, scaled_;
  linalg::SparseLdlt factor_;
  bool is_analysed_ = false;
  linalg::Vector lambda_;
};

}  // namespace buckens::stepping
