// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_rank.h"

#include <algorithm>

#include "buckens/linalg/pivoted_qr.h"
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

/// @param order all rows, the independent ones first
RowRank split_at(const std::vector<int>& order, Eigen::Index rank) {
  RowRank out;
  out.independent.assign(order.begin(), order.begin() + rank);
  out.dependent.assign(order.begin() + rank, order.end());
  std::sort(out.independent.begin(), out.independent.end());
  std::sort(out.dependent.begin(), out.dependent.end());
  return out;
}

}  // namespace

RowRank split_rows(const SparseMatrix& J, double tolerance) {
  if (J.rows() == 0) return {};
  const double entries = static_cast<double>(J.rows()) * static_cast<double>(J.cols());
  if (entries <= kDenseEntries) {
    const PivotedQr qr(Matrix(J.transpose()), tolerance);
    return split_at(qr.order(), qr.rank());
  }
  const SparseMatrix columns = J.transpose();
  return split_columns(columns, tolerance * largest_column(columns));
}

}  // namespace buckens::linalg
