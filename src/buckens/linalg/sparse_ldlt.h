// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/SparseCholesky>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A = L D Lᵀ of a sparse symmetric matrix of moderate size, Eigen's SimplicialLDLT. D may have any
/// signs; nothing is pivoted but for sparsity.
///
/// Compiled once: its templates take seconds in each piece of sources that makes them.
class SparseLdlt {
 public:
  /// The order of elimination, from the pattern; for all matrices that have it.
  void analyse(const SparseMatrix& A);
  /// @param A its lower triangle is read. @return false where a pivot is zero
  bool factorise(const SparseMatrix& A);
  Vector solve(const Vector& b) const;
  Vector diagonal() const;  ///< D

 private:
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace buckens::linalg
