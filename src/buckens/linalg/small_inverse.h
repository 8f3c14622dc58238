// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Most rows of a matrix that small_inverse() takes.
inline constexpr int kMostSmallRows = 24;

/// X ← A⁻¹ of a square matrix by LU with row exchanges, without memory from the heap.
///
/// Compiled once: Eigen's inverse of matrices with room for so many rows takes seconds in each
/// piece of sources that makes it.
/// @param A of at most kMostSmallRows rows; singular ones give numbers that are not finite
/// @param X of the size of A, not A itself
void small_inverse(const Eigen::Ref<const Matrix>& A, Eigen::Ref<Matrix> X);

}  // namespace buckens::linalg
