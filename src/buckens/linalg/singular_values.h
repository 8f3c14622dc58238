// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A = U diag(σ) Vᵀ of a dense matrix, Eigen's JacobiSVD.
///
/// Compiled once: its templates take seconds in each source that makes them.
struct SingularValues {
  Vector values;  ///< σ, descending
  Matrix U, V;    ///< orthonormal columns

  /// How many are larger than this share of the largest.
  Eigen::Index rank(double share) const;
  /// The shortest x with the least |A x − b|; A has to have full rank.
  Vector solve(const Vector& b) const;
};

enum class LeftVectors {
  thin,  ///< as many as singular values
  full,  ///< as many as rows
};

SingularValues singular_values(const Matrix& A, LeftVectors left);

}  // namespace buckens::linalg
