// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/QR>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A⁺ of a dense matrix of any rank: A⁺b is the shortest x with the least |A x − b|, Eigen's
/// CompleteOrthogonalDecomposition. Allocates where the size changes only.
///
/// Compiled once: its templates take seconds in each source that makes them.
class PseudoInverse {
 public:
  PseudoInverse() = default;
  /// @param threshold columns that add less than this share of the longest are dependent
  explicit PseudoInverse(double threshold) { orthogonal_.setThreshold(threshold); }

  void compute(const Matrix& A);
  Vector operator*(const Vector& b) const;
  Matrix operator*(const Matrix& B) const;
  Matrix whole() const;

 private:
  Eigen::CompleteOrthogonalDecomposition<Matrix> orthogonal_;
};

}  // namespace buckens::linalg
