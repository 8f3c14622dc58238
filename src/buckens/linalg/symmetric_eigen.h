// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A = V diag(λ) Vᵀ of a symmetric matrix, Eigen's SelfAdjointEigenSolver.
///
/// Compiled once: its templates take seconds in each source that makes them.
struct SymmetricEigen {
  Vector values;   ///< λ, ascending
  Matrix vectors;  ///< orthonormal columns
};

/// @param A its lower triangle is read
SymmetricEigen symmetric_eigen(const Matrix& A);
/// Ascending, without vectors.
Vector symmetric_eigenvalues(const Matrix& A);
/// Of the matrix with this diagonal and these n − 1 numbers beside it.
SymmetricEigen tridiagonal_eigen(const Vector& diagonal, const Vector& beside);
/// A x = λ B x with xᵀB x = 1; none where they cannot be found, as B is not positive definite.
std::optional<SymmetricEigen> generalised_eigen(const Matrix& A, const Matrix& B);

}  // namespace buckens::linalg
