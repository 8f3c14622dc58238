// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Takes the content of a matrix over, for several that read it. Eigen's own move operations copy
/// sparse matrices.
inline std::shared_ptr<const SparseMatrix> shared_matrix(SparseMatrix&& A) {
  auto out = std::make_shared<SparseMatrix>();
  out->swap(A);
  return out;
}

}  // namespace buckens::linalg
