// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/SparseLU>

#include "buckens/linalg/matrix_types.h"

namespace buckens::verification {

/// LU decomposition of one matrix after another. The order of the columns is chosen anew only where
/// entries have other places than before; it depends on nothing else, so the factors are the same.
class OrderedLu {
 public:
  /// @return whether the matrix is regular
  bool factorise(const linalg::SparseMatrix& A);
  linalg::Vector solve(const linalg::Vector& b) const { return lu_.solve(b); }

 private:
  Eigen::SparseLU<linalg::SparseMatrix> lu_;
  std::vector<int> starts_, rows_;  // places of the entries for which the order was chosen
};

}  // namespace buckens::verification
