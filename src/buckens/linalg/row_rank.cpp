// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_rank.h"

#include <algorithm>

#include <Eigen/QR>

#include "buckens/linalg/sparse_qr.h"

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
  const SparseMatrix columns = J.transpose();
  return split_columns(columns, tolerance * largest_column(columns));
}

}  // namespace buckens::linalg
