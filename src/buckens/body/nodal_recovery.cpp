// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_recovery.h"

#include <algorithm>
#include <cmath>

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

namespace {

// Rows of a mean over nodes that move as one sum up to 1 and to 0 but for rounding.
constexpr double kRounding = 1e-13;

}  // namespace

Vector NodalRecovery::apply(const Vector& x) const {
  if (is_identity()) return x;
  if (is_dense()) return dense() * x;
  return sparse() * x;
}

Vector NodalRecovery::transposed(const Vector& f) const {
  if (is_identity()) return f;
  if (is_dense()) return dense().transpose() * f;
  return sparse().transpose() * f;
}

NodalRecovery NodalRecovery::of(const Matrix& Z) const {
  if (is_identity()) return NodalRecovery(Z);
  if (is_dense()) return NodalRecovery(Matrix(dense() * Z));
  return NodalRecovery(Matrix(sparse() * Z));
}

Rows NodalRecovery::rows(const Rows& N) const {
  if (is_identity()) return N;
  if (is_dense()) return Matrix(N * dense()).sparseView();
  Rows out = N * Rows(sparse());
  double largest = 0.0;
  for (Eigen::Index k = 0; k < out.nonZeros(); ++k) {
    largest = std::max(largest, std::abs(out.valuePtr()[k]));
  }
  out.prune(largest, kRounding);
  return out;
}

Vector NodalRecovery::column_sizes(const Vector& scale) const {
  if (is_identity()) return scale;
  if (is_dense()) {
    return (scale.asDiagonal() * dense()).cwiseAbs().colwise().maxCoeff().transpose();
  }
  Vector out = Vector::Zero(sparse().cols());
  for (int column = 0; column < sparse().outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(sparse(), column); it; ++it) {
      out[column] = std::max(out[column], scale[it.row()] * std::abs(it.value()));
    }
  }
  return out;
}

}  // namespace buckens::body
