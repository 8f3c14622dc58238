// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_rank.h"

#include <algorithm>

#include <Eigen/QR>

#include "buckens/base/errors.h"
#include "buckens/linalg/single_thread.h"
#include "buckens/linalg/spqr_matrix.h"

namespace buckens::linalg {

namespace {

// Up to this size dense QR is faster and pivots better.
constexpr double kDenseEntries = 1e5;

double largest_column(const SparseMatrix& A) {
  double largest = 0.0;
  for (int k = 0; k < A.outerSize(); ++k) largest = std::max(largest, A.col(k).norm());
  return largest;
}

template <class Permutation>
RowRank from_permutation(const Permutation& columns, Eigen::Index rank, Eigen::Index count) {
  RowRank out;
  for (Eigen::Index k = 0; k < count; ++k) {
    (k < rank ? out.independent : out.dependent).push_back(columns.indices()[k]);
  }
  std::sort(out.independent.begin(), out.independent.end());
  std::sort(out.dependent.begin(), out.dependent.end());
  return out;
}

/// Column rank by multifrontal QR (SPQR): with a tolerance its R is a staircase in which every
/// independent column steps down.
RowRank split_sparse(const SparseMatrix& A, double tolerance) {
  const SingleThread alone;
  SpqrMatrix matrix(A);
  cholmod_sparse* R = nullptr;
  SuiteSparse_long* permutation = nullptr;
  const double limit = tolerance * largest_column(A);
  SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, limit, A.cols(), &matrix.view, &R, &permutation,
                        &matrix.common);
  if (R == nullptr) {
    throw NumericalError("the rank of the joint equations could not be found: " + matrix.failure());
  }
  RowRank out;
  const auto* starts = static_cast<const SuiteSparse_long*>(R->p);
  const auto* rows = static_cast<const SuiteSparse_long*>(R->i);
  SuiteSparse_long next = 0;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    bool steps_down = false;
    for (auto entry = starts[k]; entry < starts[k + 1]; ++entry) {
      steps_down = steps_down || rows[entry] == next;
    }
    const int column = static_cast<int>(permutation != nullptr ? permutation[k] : k);
    (steps_down ? out.independent : out.dependent).push_back(column);
    if (steps_down) ++next;
  }
  cholmod_l_free_sparse(&R, &matrix.common);
  cholmod_l_free(static_cast<std::size_t>(A.cols()), sizeof(SuiteSparse_long), permutation,
                 &matrix.common);
  std::sort(out.independent.begin(), out.independent.end());
  std::sort(out.dependent.begin(), out.dependent.end());
  return out;
}

}  // namespace

RowRank split_rows(const SparseMatrix& J, double tolerance) {
  if (J.rows() == 0) return {};
  const double entries = static_cast<double>(J.rows()) * static_cast<double>(J.cols());
  if (entries <= kDenseEntries) {
    Eigen::ColPivHouseholderQR<Matrix> qr(Matrix(J.transpose()));
    // Eigen measures pivots against the largest one.
    qr.setThreshold(tolerance);
    return from_permutation(qr.colsPermutation(), qr.rank(), J.rows());
  }
  return split_sparse(J.transpose(), tolerance);
}

}  // namespace buckens::linalg
