// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/small_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace buckens::linalg {

namespace {
// The smallest pivot by the largest: as SparseLu judges.
constexpr double kSingularSmall = 1e-14;
}  // namespace

bool SmallLu::factorise(const Matrix& A) {
  const Eigen::Index n = A.rows();
  if (n == 0) return true;
  if (!A.allFinite()) return false;
  scale_.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    scale_[k] = A(k, k) > 0.0 ? 1.0 / std::sqrt(A(k, k)) : 1.0;
  }
  scaled_.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) scaled_(i, j) = scale_[i] * A(i, j) * scale_[j];
  }
  lu_.compute(scaled_);
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double pivot = std::abs(lu_.matrixLU()(k, k));
    least = std::min(least, pivot);
    most = std::max(most, pivot);
  }
  return least > kSingularSmall * most;
}

void SmallLu::solve_in_place(Vector& x) const {
  if (x.size() == 0) return;
  scaled_x_.resize(x.size());
  scaled_x_.array() = scale_.array() * x.array();
  x.noalias() = lu_.permutationP() * scaled_x_;
  lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(x);
  lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(x);
  x.array() *= scale_.array();
}

Matrix general_solution(const Matrix& A, const Matrix& B) {
  return Eigen::PartialPivLU<Matrix>(A).solve(B);
}

Matrix general_inverse(const Matrix& A) { return Eigen::PartialPivLU<Matrix>(A).inverse(); }

}  // namespace buckens::linalg
