// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// @param first_column of A in the matrix of which it is a part
/// @throws NumericalError naming the first entry of A that is not finite
void require_finite(const SparseMatrix& A, int first_column = 0);

}  // namespace buckens::linalg
