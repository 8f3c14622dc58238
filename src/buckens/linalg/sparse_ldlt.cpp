// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_ldlt.h"

namespace buckens::linalg {

void SparseLdlt::analyse(const SparseMatrix& A) { factor_.analyzePattern(A); }

bool SparseLdlt::factorise(const SparseMatrix& A) {
  factor_.factorize(A);
  return factor_.info() == Eigen::Success;
}

Vector SparseLdlt::solve(const Vector& b) const { return factor_.solve(b); }

Vector SparseLdlt::diagonal() const { return factor_.vectorD(); }

}  // namespace buckens::linalg
