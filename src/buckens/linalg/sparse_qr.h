// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_rank.h"

namespace buckens::linalg {

/// Sparse QR A E = Q R with column pivoting by a limit: a column of which less than `limit` is left
/// beside those before it counts as dependent on them. Nothing dense is formed except vectors.
///
/// Two routes with the same answers up to rounding and the choice among dependent columns: SPQR,
/// multifrontal, under the GPL; and Eigen's SparseQR, column by column, all that a build with
/// BUCKENS_GPL=OFF has.

/// Which columns of A are independent.
/// @throws NumericalError if memory runs out
RowRank split_columns(const SparseMatrix& A, double limit);
RowRank split_columns_by_eigen(const SparseMatrix& A, double limit);

/// The minimum-norm x with Aᵀ x = b: x = Q R⁻ᵀ Eᵀ b, without dependent columns.
/// @param b in the range of Aᵀ, which is not checked
/// @throws NumericalError if memory runs out
Vector least_norm(const SparseMatrix& A, const Vector& b, double limit);
Vector least_norm_by_eigen(const SparseMatrix& A, const Vector& b, double limit);

}  // namespace buckens::linalg
