// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// @throws NumericalError naming the first entry of A that is not finite
void require_finite(const SparseMatrix& A);

}  // namespace buckens::linalg
