// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/pivoted_qr.h"

namespace buckens::linalg {

PivotedQr::PivotedQr(const Matrix& A, double threshold) : qr_(A) {
  qr_.setThreshold(threshold);
  rank_ = qr_.rank();
  const auto& columns = qr_.colsPermutation().indices();
  order_.assign(columns.begin(), columns.end());
}

Matrix PivotedQr::complement() const {
  Matrix Z = Matrix::Zero(qr_.rows(), qr_.rows() - rank_);
  Z.bottomRows(Z.cols()).setIdentity();
  return qr_.householderQ().setLength(rank_) * Z;
}

Matrix orthonormal_span(const Matrix& A) {
  const Eigen::HouseholderQR<Matrix> qr(A);
  return qr.householderQ() * Matrix::Identity(A.rows(), A.cols());
}

}  // namespace buckens::linalg
