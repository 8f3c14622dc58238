// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/LU>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// LU factors of a small dense matrix with row exchanges.
///
/// Rows and columns are scaled by the roots of the diagonal first, so that units of rows do not
/// decide about pivots: for matrices near a positive definite one. Keeps nothing of the last
/// factorisation, and allocates where the size changes only.
class SmallLu {
 public:
  /// @param A square. @return false if it is singular to working precision
  bool factorise(const Matrix& A);
  /// x ← A⁻¹ x with the last factorisation.
  void solve_in_place(Vector& x) const;

 private:
  Vector scale_;
  Matrix scaled_;
  Eigen::PartialPivLU<Matrix> lu_;
  mutable Vector scaled_x_;
};

/// A⁻¹B of a dense matrix, by LU with row exchanges.
Matrix general_solution(const Matrix& A, const Matrix& B);
Matrix general_inverse(const Matrix& A);

}  // namespace buckens::linalg
