// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A = Pᵀ L D Lᵀ P of a dense symmetric matrix that is positive or negative semidefinite, Eigen's
/// LDLT.
///
/// Compiled once: its templates take seconds in each piece of sources that makes them.
class DenseLdlt {
 public:
  /// @param A its lower triangle is read
  explicit DenseLdlt(const Matrix& A);

  Vector solve(const Vector& b) const;
  Matrix solve(const Matrix& B) const;

 private:
  Eigen::LDLT<Matrix> factor_;
};

}  // namespace buckens::linalg
