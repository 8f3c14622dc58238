// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_rank.h"

#include <algorithm>

#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseQR>

namespace buckens::linalg {

namespace {

constexpr double kDenseEntries = 4e6;

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
  SparseMatrix transposed = J.transpose();
  transposed.makeCompressed();
  double largest = 0.0;
  for (int k = 0; k < transposed.outerSize(); ++k) {
    largest = std::max(largest, transposed.col(k).norm());
  }
  Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(tolerance * largest);
  qr.compute(transposed);
  return from_permutation(qr.colsPermutation(), qr.rank(), J.rows());
}

}  // namespace buckens::linalg
