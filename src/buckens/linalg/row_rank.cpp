// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_rank.h"

#include <algorithm>

#include <Eigen/QR>
#include <SuiteSparseQR.hpp>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {

// Up to this size dense QR is quicker and pivots better.
constexpr double kDenseEntries = 1e5;

/// Copy of a matrix in the long indices that SPQR takes.
struct SpqrMatrix {
  explicit SpqrMatrix(const SparseMatrix& A)
      : starts(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1),
        rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()),
        values(A.valuePtr(), A.valuePtr() + A.nonZeros()) {
    cholmod_l_start(&common);
    common.print = 0;
    view.nrow = static_cast<std::size_t>(A.rows());
    view.ncol = static_cast<std::size_t>(A.cols());
    view.nzmax = values.size();
    view.p = starts.data();
    view.i = rows.data();
    view.x = values.data();
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
  }
  ~SpqrMatrix() { cholmod_l_finish(&common); }
  SpqrMatrix(const SpqrMatrix&) = delete;
  SpqrMatrix& operator=(const SpqrMatrix&) = delete;

  std::vector<SuiteSparse_long> starts, rows;
  std::vector<double> values;
  cholmod_sparse view{};
  cholmod_common common{};
};

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
  SpqrMatrix matrix(A);
  cholmod_sparse* R = nullptr;
  SuiteSparse_long* permutation = nullptr;
  const double limit = tolerance * largest_column(A);
  SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, limit, A.cols(), &matrix.view, &R, &permutation,
                        &matrix.common);
  if (R == nullptr) {
    throw NumericalError("the rank of the joint equations could not be found; is memory short?");
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
