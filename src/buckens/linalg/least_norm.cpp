// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/least_norm.h"

#include <algorithm>

#include "buckens/linalg/sparse_qr.h"

namespace buckens::linalg {

Vector least_norm_solution(const SparseMatrix& A, const Vector& b, double tolerance) {
  if (A.cols() == 0 || A.rows() == 0) return Vector::Zero(A.cols());
  const SparseMatrix equations = A.transpose();  // a column each
  double longest = 0.0;
  for (int k = 0; k < equations.outerSize(); ++k) {
    longest = std::max(longest, equations.col(k).norm());
  }
  // Nothing is held: of joints that have all let go. SPQR refuses matrices without entries.
  if (longest == 0.0) return Vector::Zero(A.cols());
  return least_norm(equations, b, tolerance * longest);
}

}  // namespace buckens::linalg
