// SPDX-License-Identifier: Apache-2.0
#include "verification/monolithic/ordered_lu.h"

#include <algorithm>

namespace buckens::verification {

bool OrderedLu::factorise(const linalg::SparseMatrix& A) {
  const auto is_same = [](const std::vector<int>& known, const int* found, Eigen::Index count) {
    return static_cast<Eigen::Index>(known.size()) == count &&
           std::equal(known.begin(), known.end(), found);
  };
  const int *starts = A.outerIndexPtr(), *rows = A.innerIndexPtr();
  if (!is_same(starts_, starts, A.cols() + 1) || !is_same(rows_, rows, A.nonZeros())) {
    lu_.analyzePattern(A);
    starts_.assign(starts, starts + A.cols() + 1);
    rows_.assign(rows, rows + A.nonZeros());
  }
  lu_.factorize(A);
  return lu_.info() == Eigen::Success;
}

}  // namespace buckens::verification
