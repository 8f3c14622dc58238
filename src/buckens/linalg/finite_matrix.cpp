// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/finite_matrix.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/cholmod_factor.h"

namespace buckens::linalg {

IndefiniteMatrix::IndefiniteMatrix(Eigen::Index size, Eigen::Index column)
    : NumericalError(fmt::format(
          "a matrix of size {} is not positive definite (column {}); check masses and materials of "
          "the body; over-refined beams can cause this: use fewer elements",
          size, column)),
      column_(column) {}

void require_finite(const SparseMatrix& A, int first_column) {
  for (int column = 0; column < A.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) {
      if (std::isfinite(it.value())) continue;
      throw NumericalError(fmt::format(
          "a matrix of size {} has an entry that is not finite (row {}, column {}: {}); check "
          "masses, materials, sections and the step",
          A.rows(), it.row(), first_column + column, it.value()));
    }
  }
}

}  // namespace buckens::linalg
