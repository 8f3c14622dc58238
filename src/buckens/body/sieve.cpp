// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/sieve.h"

#include <cmath>
#include <utility>

#include "buckens/body/nodal_motion.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::Vector;

namespace {
// Eigenvalues of the diagonally scaled S below this are motions without inertia.
constexpr double kEmptyRow = 1e-12;
// Of at most six motions: needs no memory of its own.
using Amplitudes = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
}  // namespace

Sieve::Sieve(const Matrix& Phi, const linalg::SymmetricMatrix& M) {
  if (M.is_divided() || M.nodes() != nullptr) {
    S_ = Phi.transpose() * (M * Phi);
  } else {  // Eigen adds up in another order if M Φ is not a part of the expression
    S_ = Phi.transpose() * (M.whole() * Phi);
  }
  S_ = 0.5 * (S_ + S_.transpose().eval());
  Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Zero();
  const double translation = S_.diagonal().head<3>().maxCoeff();
  const double rotation = S_.diagonal().tail<3>().maxCoeff();
  for (int k = 0; k < 6; ++k) {
    const double reference = k < 3 ? translation : rotation;
    if (S_(k, k) > kEmptyRow * reference) scale[k] = 1.0 / std::sqrt(S_(k, k));
  }
  const Eigen::Matrix<double, 6, 6> scaled = scale.asDiagonal() * S_ * scale.asDiagonal();
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(scaled);
  to_axes_.resize(6, 0);
  for (int k = 0; k < 6; ++k) {
    if (eigen.values[k] < kEmptyRow) continue;
    to_axes_.conservativeResize(6, to_axes_.cols() + 1);
    to_axes_.rightCols<1>() = scale.cwiseProduct(eigen.vectors.col(k)) / std::sqrt(eigen.values[k]);
  }
  Phi_ = Phi * to_axes_;
  P_ = M * Phi_;
}

void Sieve::keep_by_node(std::shared_ptr<const NodalMotion> motion) {
  by_node_ = std::move(motion);
  Phi_ = P_ = Matrix();
}

Matrix Sieve::Phi() const { return by_node_ ? by_node_->Phi() : Phi_; }

Matrix Sieve::P() const { return by_node_ ? by_node_->P() : P_; }

void Sieve::apply(Vector& d) const {
  if (rank() == 0) return;
  if (by_node_) {
    by_node_->subtract_motion(by_node_->momenta(d), d);
    return;
  }
  const Amplitudes rigid = P_.transpose() * d;
  d.noalias() -= Phi_ * rigid;
}

void Sieve::apply(Matrix& columns) const {
  if (rank() == 0) return;
  if (by_node_) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      by_node_->subtract_motion(by_node_->momenta(columns.col(k)), columns.col(k));
    }
    return;
  }
  const Matrix amplitudes = P_.transpose() * columns;
  columns.noalias() -= Phi_ * amplitudes;
}

void Sieve::apply_transposed(Vector& f) const {
  if (rank() == 0) return;
  if (by_node_) {
    by_node_->subtract_load(by_node_->resultants(f), f);
    return;
  }
  const Amplitudes rigid = Phi_.transpose() * f;
  f.noalias() -= P_ * rigid;
}

void Sieve::apply_transposed(Matrix& loads) const {
  if (rank() == 0) return;
  if (by_node_) {
    for (Eigen::Index k = 0; k < loads.cols(); ++k) {
      by_node_->subtract_load(by_node_->resultants(loads.col(k)), loads.col(k));
    }
    return;
  }
  const Matrix amplitudes = Phi_.transpose() * loads;
  loads.noalias() -= P_ * amplitudes;
}

Eigen::Matrix<double, 6, 1> Sieve::rigid_part(const Vector& d) const {
  if (by_node_) return to_axes_ * by_node_->momenta(d);
  return to_axes_ * (P_.transpose() * d);
}

}  // namespace buckens::body
