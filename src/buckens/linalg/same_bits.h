// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <Eigen/SparseCore>

namespace buckens::linalg {

/// Whether two compressed sparse matrices have the same pattern and equal entries, to the last bit.
template <class Sparse>
bool have_same_bits(const Sparse& A, const Sparse& B) {
  if (A.rows() != B.rows() || A.nonZeros() != B.nonZeros()) return false;
  const auto same = [](const auto* a, const auto* b, Eigen::Index count) {
    return std::equal(a, a + count, b);
  };
  return same(A.valuePtr(), B.valuePtr(), A.nonZeros()) &&
         same(A.innerIndexPtr(), B.innerIndexPtr(), A.nonZeros()) &&
         same(A.outerIndexPtr(), B.outerIndexPtr(), A.outerSize() + 1);
}

}  // namespace buckens::linalg
