// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_qr.h"

#include <algorithm>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {

using Qr = Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>>;

void factorise(const SparseMatrix& A, double limit, Qr& qr) {
  SparseMatrix compressed = A;
  compressed.makeCompressed();
  qr.setPivotThreshold(limit);
  qr.compute(compressed);
  if (qr.info() != Eigen::Success) throw NumericalError("a sparse QR factorisation failed");
}

}  // namespace

RowRank split_columns_by_eigen(const SparseMatrix& A, double limit) {
  Qr qr;
  factorise(A, limit, qr);
  RowRank out;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    const int column = qr.colsPermutation().indices()[k];
    (k < qr.rank() ? out.independent : out.dependent).push_back(column);
  }
  std::sort(out.independent.begin(), out.independent.end());
  std::sort(out.dependent.begin(), out.dependent.end());
  return out;
}

Vector least_norm_by_eigen(const SparseMatrix& A, const Vector& b, double limit) {
  Qr qr;
  factorise(A, limit, qr);
  const Eigen::Index rank = qr.rank();
  const Vector sides = qr.colsPermutation().transpose() * b;
  const SparseMatrix R = SparseMatrix(qr.matrixR()).topLeftCorner(rank, rank);
  Vector y = Vector::Zero(A.rows());
  y.head(rank) = R.transpose().triangularView<Eigen::Lower>().solve(sides.head(rank));
  return qr.matrixQ() * y;
}

}  // namespace buckens::linalg
