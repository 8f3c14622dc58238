// SPDX-License-Identifier: Apache-2.0
// What a build with BUCKENS_GPL=OFF takes; with_gpl.cpp is its counterpart.
#include "buckens/base/errors.h"
#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/gpl_parts.h"
#include "buckens/linalg/sparse_qr.h"

namespace buckens::linalg {

bool has_gpl_parts() { return false; }

RowRank split_columns(const SparseMatrix& A, double limit) {
  return split_columns_by_eigen(A, limit);
}

Vector least_norm(const SparseMatrix& A, const Vector& b, double limit) {
  return least_norm_by_eigen(A, b, limit);
}

std::unique_ptr<CholmodFactor> CholmodFactor::make(const SparseMatrix&, const Options&) {
  throw NumericalError(
      "this build has no CHOLMOD, which serves as a reference only: build with BUCKENS_GPL=ON, or "
      "take the route of panels");
}

}  // namespace buckens::linalg
