// SPDX-License-Identifier: Apache-2.0
// What a build with libraries under the GPL takes; without_gpl.cpp is its counterpart.
#include "buckens/linalg/gpl_parts.h"
#include "buckens/linalg/sparse_qr.h"
#include "buckens/linalg/spqr.h"

namespace buckens::linalg {

bool has_gpl_parts() { return true; }

RowRank split_columns(const SparseMatrix& A, double limit) {
  return split_columns_by_spqr(A, limit);
}

Vector least_norm(const SparseMatrix& A, const Vector& b, double limit) {
  return least_norm_by_spqr(A, b, limit);
}

}  // namespace buckens::linalg
