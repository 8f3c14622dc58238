// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/tall_products.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <cblas.h>

#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/node_blocks.h"
#include "buckens/linalg/node_matrix.h"
#include "buckens/linalg/row_parts.h"
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

Matrix inner_products(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B,
                      TaskPool* pool) {
  const RowParts parts(B.rows());
  std::vector<Matrix> sums(static_cast<std::size_t>(parts.count()));
  run_tasks(pool, parts.count(), [&](int part) {
    const Eigen::Index begin = parts.begin(part);
    const Eigen::Index rows = parts.end(part) - begin;
    Matrix& sum = sums[static_cast<std::size_t>(part)];
    sum = Matrix::Zero(A.cols(), B.cols());
    multiply_by_blas(CblasTrans, 1.0, A.middleRows(begin, rows), B.middleRows(begin, rows), 0.0,
                     sum);
  });
  for (std::size_t part = 1; part < sums.size(); ++part) sums[0] += sums[part];
  return sums[0];
}

// B is written to through the copy.
void subtract_combinations(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& S,
                           Eigen::Ref<Matrix> B,  // NOLINT(performance-unnecessary-value-param)
                           TaskPool* pool) {
  const RowParts parts(B.rows());
  run_tasks(pool, parts.count(), [&](int part) {
    const Eigen::Index begin = parts.begin(part);
    const Eigen::Index rows = parts.end(part) - begin;
    multiply_by_blas(CblasNoTrans, -1.0, A.middleRows(begin, rows), S, 1.0,
                     B.middleRows(begin, rows));
  });
}

Matrix combinations(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& S,
                    TaskPool* pool) {
  Matrix out(A.rows(), S.cols());
  const RowParts parts(A.rows());
  run_tasks(pool, parts.count(), [&](int part) {
    const Eigen::Index begin = parts.begin(part);
    const Eigen::Index rows = parts.end(part) - begin;
    out.middleRows(begin, rows).setZero();
    multiply_by_blas(CblasNoTrans, 1.0, A.middleRows(begin, rows), S, 0.0,
                     out.middleRows(begin, rows));
  });
  return out;
}

namespace {

/// By orders for several columns at once. @pre A.is_divided()
Matrix divided_product(const SymmetricMatrix& A, const Eigen::Ref<const Matrix>& X) {
  Matrix out(A.rows(), X.cols());
  std::vector<DividedMatrix::Product> products;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    products.push_back({&A.divide(), X.col(k).data(), out.col(k).data()});
  }
  DividedMatrix::multiply(products);
  return out;
}

/// @tparam Column goes through the entries of a column, rows ascending
template <class Column, class Symmetric>
Matrix product_by_columns(const Symmetric& A, const Eigen::Ref<const Matrix>& X, TaskPool* pool) {
  const Eigen::Index n = X.rows();
  Matrix out(n, X.cols());
  const RowParts parts(n);
  // Columns side by side, so that an entry meets all of them in one place.
  std::vector<double> beside(static_cast<std::size_t>(kColumnsAtOnce * n), 0.0);
  for (Eigen::Index done = 0; done < X.cols(); done += kColumnsAtOnce) {
    const Eigen::Index columns = std::min<Eigen::Index>(kColumnsAtOnce, X.cols() - done);
    run_tasks(pool, parts.count(), [&](int part) {
      for (Eigen::Index c = 0; c < columns; ++c) {
        double* to = beside.data() + c;
        for (Eigen::Index i = parts.begin(part); i < parts.end(part); ++i) {
          to[kColumnsAtOnce * i] = X(i, done + c);
        }
      }
    });
    run_tasks(pool, parts.count(), [&](int part) {
      for (Eigen::Index j = parts.begin(part); j < parts.end(part); ++j) {
        double sum[kColumnsAtOnce] = {};
        for (Column it(A, j); it; ++it) {
          const double* x = beside.data() + static_cast<std::ptrdiff_t>(kColumnsAtOnce) * it.row();
          for (int c = 0; c < kColumnsAtOnce; ++c) sum[c] += it.value() * x[c];
        }
        for (Eigen::Index c = 0; c < columns; ++c) out(j, done + c) = sum[c];
      }
    });
  }
  return out;
}

}  // namespace

Matrix symmetric_product(const SparseMatrix& A, const Eigen::Ref<const Matrix>& X, TaskPool* pool) {
  return product_by_columns<SparseMatrix::InnerIterator>(A, X, pool);
}

Matrix symmetric_product(const SymmetricMatrix& A, const Eigen::Ref<const Matrix>& X,
                         TaskPool* pool) {
  if (A.is_divided()) return divided_product(A, X);
  if (A.blocks() != nullptr) return product_by_columns<NodeBlocks::Column>(*A.blocks(), X, pool);
  if (A.nodes() == nullptr) return symmetric_product(A.whole(), X, pool);
  Matrix out(X.rows(), X.cols());
  const NodeMatrix nodes = node_matrix(*A.nodes());
  const NodeKernels& kernels = node_kernels();
  const RowParts rows(X.rows(), 3);
  // All columns meet a piece of the matrix while the cache holds it.
  rows.for_pieces(pool, [&](int /*part*/, Eigen::Index first, Eigen::Index size) {
    for (Eigen::Index k = 0; k < X.cols(); ++k) {
      kernels.multiply(nodes, static_cast<int>(first / 3), static_cast<int>(size / 3),
                       X.col(k).data(), out.col(k).data());
    }
  });
  return out;
}

}  // namespace buckens::linalg
