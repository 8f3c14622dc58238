// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// The shortest x of all that satisfy A x = b, for a sparse A of any rank.
///
/// Sparse QR of Aᵀ: Aᵀ E = Q R, x = Q R⁻ᵀ Eᵀb, dependent equations left out. Cost that of the
/// factorisation; nothing dense is formed but vectors.
/// @param b in the range of A; what is not, is not noticed
/// @param tolerance relative to the longest equation, below which one follows from others
/// @throws NumericalError if memory is short
Vector least_norm_solution(const SparseMatrix& A, const Vector& b, double tolerance);

}  // namespace buckens::linalg
