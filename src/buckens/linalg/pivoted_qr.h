// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/QR>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// QR of a dense matrix whose columns are taken in the order of what they add, Eigen's
/// ColPivHouseholderQR.
///
/// Compiled once: its templates take seconds in each source that makes them.
class PivotedQr {
 public:
  /// @param threshold what adds less than this share of the longest column is dependent
  explicit PivotedQr(const Matrix& A, double threshold = 1e-12);

  Eigen::Index rank() const { return rank_; }
  /// All columns, the independent ones first.
  const std::vector<int>& order() const { return order_; }
  /// Orthonormal columns Z, as many as rows less the rank, with AᵀZ = 0.
  Matrix complement() const;

 private:
  Eigen::ColPivHouseholderQR<Matrix> qr_;
  Eigen::Index rank_ = 0;
  std::vector<int> order_;
};

/// Orthonormal columns with the same span, in their order; they have to be independent.
Matrix orthonormal_span(const Matrix& A);

}  // namespace buckens::linalg
