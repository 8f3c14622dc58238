// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/small_inverse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {

/// LU factors in columns of n rows.
struct Factors {
  std::array<double, kMostSmallRows * kMostSmallRows> values;
  std::array<int, kMostSmallRows> exchanged;  // of each row, with this one or a later one
  int n = 0;

  double* column(int j) { return values.data() + static_cast<std::size_t>(j * n); }

  void exchange_rows(int k) {
    const double* const own = column(k);
    int best = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(own[i]) > std::abs(own[best])) best = i;
    }
    exchanged[static_cast<std::size_t>(k)] = best;
    if (best == k) return;
    for (int j = 0; j < n; ++j) std::swap(column(j)[k], column(j)[best]);
  }

  void factorise() {
    for (int k = 0; k < n; ++k) {
      exchange_rows(k);
      double* const own = column(k);
      for (int i = k + 1; i < n; ++i) own[i] /= own[k];
      for (int j = k + 1; j < n; ++j) {
        double* const other = column(j);
        for (int i = k + 1; i < n; ++i) other[i] -= own[i] * other[k];
      }
    }
  }

  void solve_in_place(double* x) {
    for (int k = 0; k < n; ++k) std::swap(x[k], x[exchanged[static_cast<std::size_t>(k)]]);
    for (int k = 0; k < n; ++k) {
      const double* const own = column(k);
      for (int i = k + 1; i < n; ++i) x[i] -= own[i] * x[k];
    }
    for (int k = n - 1; k >= 0; --k) {
      const double* const own = column(k);
      x[k] /= own[k];
      for (int i = 0; i < k; ++i) x[i] -= own[i] * x[k];
    }
  }
};

}  // namespace

void small_inverse(const Eigen::Ref<const Matrix>& A, Eigen::Ref<Matrix> X) {
  BUCKENS_ASSERT(A.rows() <= kMostSmallRows && A.rows() == A.cols());
  Factors lu;
  lu.n = static_cast<int>(A.rows());
  for (int j = 0; j < lu.n; ++j) {
    std::copy_n(A.data() + j * A.outerStride(), lu.n, lu.column(j));
  }
  lu.factorise();
  for (int j = 0; j < lu.n; ++j) {
    double* const x = X.data() + j * X.outerStride();
    std::fill_n(x, lu.n, 0.0);
    x[j] = 1.0;
    lu.solve_in_place(x);
  }
}

}  // namespace buckens::linalg
