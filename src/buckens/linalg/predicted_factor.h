// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_sum.h"

namespace buckens::linalg {

/// Memory of the Cholesky factor of a matrix, found from the pattern of its entries.
struct PredictedFactor {
  double bytes = 0;  ///< of the factor
  double peak = 0;   ///< at most, with the fronts that one thread needs while it is computed
};

/// @param A the values are not read, and it is not formed, wherever its terms are. Takes a tenth
/// of the time of the factor, or less.
PredictedFactor predict_factor(const MatrixSum& A);

/// Bytes that no factor of a matrix of this size exceeds: those of a full triangle.
double most_factor_bytes(Eigen::Index size);

}  // namespace buckens::linalg
