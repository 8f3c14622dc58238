// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_motion.h"

#include "buckens/body/nodal_inertia.h"
#include "buckens/body/second_moments.h"
#include "buckens/spatial/rotation.h"

namespace buckens::body {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix4d;
using linalg::Matrix;
using linalg::NodeSums;
using linalg::Vector;

namespace {

// Relative to the largest number of a column: entries are sums of some dozens of products.
constexpr double kSame = 1e-12;

bool are_close(const Vector& a, const Vector& b) {
  return (a - b).lpNorm<Eigen::Infinity>() <= kSame * b.lpNorm<Eigen::Infinity>();
}

/// Σ x sᵀ, and Σ m x as last column.
Eigen::Matrix<double, 3, 4> moments_in(const NodeSums& sums) {
  return Eigen::Map<const Matrix4d>(sums.value).topRows<3>();
}

}  // namespace

std::shared_ptr<const NodalMotion> NodalMotion::of(const FlexiblePart& part) {
  const NodalInertia nodal(part.fe.shape.nodal);
  const bool may_be = !nodal.empty() && nodal.is_regular() && part.sieve.rank() == 6 &&
                      part.recovery.is_identity() && part.num_dofs() == 3 * nodal.matrix().nodes &&
                      static_cast<Index>(part.fe.nodes.size()) == nodal.matrix().nodes;
  if (!may_be) return nullptr;
  const std::shared_ptr<const NodalMotion> out(new NodalMotion(part));
  return out->describes(part) ? out : nullptr;
}

NodalMotion::NodalMotion(const FlexiblePart& part)
    : kernels_(&linalg::node_kernels()),
      positions_(4, static_cast<Index>(part.fe.nodes.size())),
      first_moments_(4, positions_.cols()) {
  const linalg::SparseMatrix& Ms = part.fe.shape.nodal.Ms;
  values_.assign(Ms.valuePtr(), Ms.valuePtr() + Ms.nonZeros());
  rows_.assign(Ms.innerIndexPtr(), Ms.innerIndexPtr() + Ms.nonZeros());
  begin_.assign(Ms.outerIndexPtr(), Ms.outerIndexPtr() + Ms.outerSize() + 1);
  for (Index j = 0; j < positions_.cols(); ++j) {
    const Eigen::Vector3d X =
        part.fe.nodes[static_cast<std::size_t>(j)].position - part.fe.shape.com;
    positions_.col(j) << X, 1.0;
  }
  first_moments_ = positions_ * Ms;
  for (Index k = 0; k < 6; ++k) to_axes_.col(k) = part.sieve.rigid_part(part.sieve.Phi().col(k));
}

bool NodalMotion::describes(const FlexiblePart& part) const {
  const Index n = part.num_dofs();
  for (Index k = 0; k < 6; ++k) {
    const Matrix4d T = motion(Vector6::Unit(k));
    const Matrix Phi = T.topRows<3>() * positions_;
    const Matrix P = T.topRows<3>() * first_moments_;
    if (!are_close(Eigen::Map<const Vector>(Phi.data(), n), part.sieve.Phi().col(k)) ||
        !are_close(Eigen::Map<const Vector>(P.data(), n), part.sieve.P().col(k))) {
      return false;
    }
    const auto [a, b] = kPairs[static_cast<std::size_t>(k)];
    Eigen::Matrix3Xd pattern = Eigen::Matrix3Xd::Zero(3, positions_.cols());
    pattern.row(b) += first_moments_.row(a);
    if (a != b) pattern.row(a) += first_moments_.row(b);
    if (!are_close(Eigen::Map<const Vector>(pattern.data(), n),
                   part.invariants.centrifugal_patterns().col(k))) {
      return false;
    }
  }
  return true;
}

bool NodalMotion::operator==(const NodalMotion& other) const {
  return positions_ == other.positions_ && first_moments_ == other.first_moments_ &&
         to_axes_ == other.to_axes_ && values_ == other.values_ && rows_ == other.rows_ &&
         begin_ == other.begin_;
}

linalg::NodeMatrix NodalMotion::mass() const {
  return {values_.data(), rows_.data(), begin_.data(), static_cast<int>(positions_.cols())};
}

void NodalMotion::multiply_mass(Index first, Index size, const Vector& x, Vector& y) const {
  kernels_->multiply(mass(), static_cast<int>(first / 3), static_cast<int>(size / 3), x.data(),
                     y.data());
}

void NodalMotion::add_moments(Index first, Index size, const Vector& x, NodeSums& sums) const {
  kernels_->moments(first_moments_.data(), static_cast<int>(first / 3), static_cast<int>(size / 3),
                    x.data(), sums);
}

NodalMotion::Vector6 NodalMotion::rigid(const NodeSums& sums) const {
  const Eigen::Matrix<double, 3, 4> moments = moments_in(sums);
  Vector6 momenta;
  // (s × x)_1 = s_2 x_3 − s_3 x_2.
  momenta << moments.col(3), -axial(Matrix3d(moments.leftCols<3>()));
  return to_axes_.transpose() * momenta;
}

NodalMotion::Vector6 NodalMotion::patterns(const NodeSums& sums) {
  const Eigen::Matrix<double, 3, 4> moments = moments_in(sums);
  Vector6 out;
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto [a, b] = kPairs[k];
    out[static_cast<Index>(k)] = moments(b, a) + (a != b ? moments(a, b) : 0.0);
  }
  return out;
}

Matrix4d NodalMotion::motion(const Vector6& rigid) const {
  const Vector6 axes = to_axes_ * rigid;
  Matrix4d out = Matrix4d::Zero();
  out.topLeftCorner<3, 3>() = spatial::skew(axes.tail<3>());
  out.topRightCorner<3, 1>() = axes.head<3>();
  return out;
}

void NodalMotion::subtract(Index first, Index size, const Matrix4d& motion, Vector& y) const {
  kernels_->subtract(positions_.data(), static_cast<int>(first / 3), static_cast<int>(size / 3),
                     motion.data(), y.data());
}

}  // namespace buckens::body
