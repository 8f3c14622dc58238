// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A = L Lᵀ of a dense symmetric matrix, Eigen's LLT.
///
/// Compiled once: its templates take seconds in each source that makes them.
class DenseCholesky {
 public:
  /// @param A its lower triangle is read
  explicit DenseCholesky(const Matrix& A);

  bool is_positive_definite() const;
  /// An estimate of 1/cond(A).
  double rcond() const;
  Matrix lower() const;
  Vector diagonal() const;  ///< of L
  Vector solve(const Vector& b) const;
  Matrix solve(const Matrix& B) const;
  void solve_in_place(Matrix& B) const;
  /// L⁻¹ B
  Matrix solve_lower(const Matrix& B) const;

 private:
  Eigen::LLT<Matrix> factor_;
};

}  // namespace buckens::linalg
