// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// The minimum-norm x with A x = b, for a sparse A of any rank.
///
/// Sparse QR of Aᵀ: Aᵀ E = Q R, x = Q R⁻ᵀ Eᵀb, dependent equations left out. Cost: the
/// factorisation; nothing dense is formed except vectors.
/// @param b in the range of A, which is not checked
/// @param tolerance relative to the longest equation, below which one counts as dependent
/// @throws NumericalError if memory runs out
Vector least_norm_solution(const SparseMatrix& A, const Vector& b, double tolerance);

}  // namespace buckens::linalg
