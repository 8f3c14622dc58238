// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/tall_products.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <cblas.h>

#include "buckens/linalg/single_thread.h"

namespace buckens::linalg {

namespace {

constexpr int kColumnsAtOnce = 8;

blasint blas_size(Eigen::Index value) { return static_cast<blasint>(value); }

/// C ← α A B + β C, or AᵀB.
void multiply_by_blas(CBLAS_TRANSPOSE transposed, double alpha, const Eigen::Ref<const Matrix>& A,
                      const Eigen::Ref<const Matrix>& B, double beta, Eigen::Ref<Matrix> C) {
  const Eigen::Index inner = B.rows();
  if (C.size() == 0) return;
  if (inner == 0) {
    C *= beta;
    return;
  }
  const SingleThread alone;
  cblas_dgemm(CblasColMajor, transposed, CblasNoTrans, blas_size(C.rows()), blas_size(C.cols()),
              blas_size(inner), alpha, A.data(), blas_size(A.outerStride()), B.data(),
              blas_size(B.outerStride()), beta, C.data(), blas_size(C.outerStride()));
}

}  // namespace

Matrix inner_products(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B) {
  Matrix out = Matrix::Zero(A.cols(), B.cols());
  multiply_by_blas(CblasTrans, 1.0, A, B, 0.0, out);
  return out;
}

// B is written to through the copy.
void subtract_combinations(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& S,
                           Eigen::Ref<Matrix> B) {  // NOLINT(performance-unnecessary-value-param)
  multiply_by_blas(CblasNoTrans, -1.0, A, S, 1.0, B);
}

Matrix combinations(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& S) {
  Matrix out = Matrix::Zero(A.rows(), S.cols());
  multiply_by_blas(CblasNoTrans, 1.0, A, S, 0.0, out);
  return out;
}

Matrix symmetric_product(const SparseMatrix& A, const Eigen::Ref<const Matrix>& X) {
  const Eigen::Index n = A.rows();
  Matrix out(n, X.cols());
  // Columns side by side, so that an entry meets all of them in one place.
  std::vector<double> beside(static_cast<std::size_t>(kColumnsAtOnce * n), 0.0);
  for (Eigen::Index done = 0; done < X.cols(); done += kColumnsAtOnce) {
    const Eigen::Index columns = std::min<Eigen::Index>(kColumnsAtOnce, X.cols() - done);
    for (Eigen::Index c = 0; c < columns; ++c) {
      double* to = beside.data() + c;
      for (Eigen::Index i = 0; i < n; ++i) to[kColumnsAtOnce * i] = X(i, done + c);
    }
    for (Eigen::Index j = 0; j < n; ++j) {
      double sum[kColumnsAtOnce] = {};
      for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
        const double* x = beside.data() + static_cast<std::ptrdiff_t>(kColumnsAtOnce) * it.row();
        for (int c = 0; c < kColumnsAtOnce; ++c) sum[c] += it.value() * x[c];
      }
      for (Eigen::Index c = 0; c < columns; ++c) out(j, done + c) = sum[c];
    }
  }
  return out;
}

}  // namespace buckens::linalg
