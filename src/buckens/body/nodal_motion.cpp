// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_motion.h"

#include "buckens/body/nodal_inertia.h"
#include "buckens/body/second_moments.h"
#include "buckens/linalg/node_matrix.h"
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
                      part.num_dofs() == 3 * nodal.matrix().nodes &&
                      static_cast<Index>(part.fe.nodes.size()) == nodal.matrix().nodes;
  if (!may_be) return nullptr;
  const std::shared_ptr<const NodalMotion> out(new NodalMotion(part));
  return out->describes(part) ? out : nullptr;
}

NodalMotion::NodalMotion(const FlexiblePart& part)
    : kernels_(&linalg::node_kernels()),
      Ms_(part.fe.shape.nodal.Ms),
      positions_(4, static_cast<Index>(part.fe.nodes.size())),
      to_axes_(part.sieve.to_axes()) {
  for (Index j = 0; j < positions_.cols(); ++j) {
    const Eigen::Vector3d X =
        part.fe.nodes[static_cast<std::size_t>(j)].position - part.fe.shape.com;
    positions_.col(j) << X, 1.0;
  }
  first_moments_ = positions_ * *Ms_;
}

bool NodalMotion::describes(const FlexiblePart& part) const {
  const auto are_alike = [](const Matrix& a, const Matrix& b) {
    for (Index k = 0; k < b.cols(); ++k) {
      if (!are_close(a.col(k), b.col(k))) return false;
    }
    return a.cols() == b.cols();
  };
  return are_alike(Phi(), part.sieve.stored_Phi()) && are_alike(P(), part.sieve.stored_P()) &&
         are_alike(first_moments(), part.fe.shape.c);
}

bool NodalMotion::operator==(const NodalMotion& other) const {
  return positions_ == other.positions_ && first_moments_ == other.first_moments_ &&
         to_axes_ == other.to_axes_ && Ms_.has_same_bits(other.Ms_);
}

linalg::NodeMatrix NodalMotion::mass() const { return linalg::node_matrix(*Ms_); }

NodalMotion::Vector6 NodalMotion::resultants(const Input& f) const {
  NodeSums sums;
  kernels_->moments(positions_.data(), 0, static_cast<int>(positions_.cols()), f.data(), sums);
  return rigid(sums);
}

void NodalMotion::subtract_motion(const Vector6& a, InPlace x) const {
  kernels_->subtract(positions_.data(), 0, static_cast<int>(positions_.cols()), motion(a).data(),
                     x.data());
}

void NodalMotion::subtract_load(const Vector6& a, InPlace f) const {
  kernels_->subtract(first_moments_.data(), 0, static_cast<int>(positions_.cols()),
                     motion(a).data(), f.data());
}

NodeSums NodalMotion::moments(const Input& x) const {
  NodeSums sums;
  kernels_->moments(first_moments_.data(), 0, static_cast<int>(positions_.cols()), x.data(), sums);
  return sums;
}

Matrix4d NodalMotion::pattern_motion(const Vector6& weights) {
  Matrix4d T = Matrix4d::Zero();
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto [a, b] = kPairs[k];
    T(b, a) -= weights[static_cast<Index>(k)];
    if (a != b) T(a, b) -= weights[static_cast<Index>(k)];
  }
  return T;
}

void NodalMotion::add_pattern_load(const Vector6& weights, InPlace f) const {
  kernels_->subtract(first_moments_.data(), 0, static_cast<int>(positions_.cols()),
                     pattern_motion(weights).data(), f.data());
}

/// Those of the six motions that `places` make. @param places positions or first moments
Matrix NodalMotion::columns(const Eigen::Matrix4Xd& places) const {
  Matrix out(num_dofs(), 6);
  for (Index k = 0; k < 6; ++k) {
    Eigen::Map<Eigen::Matrix3Xd>(out.col(k).data(), 3, places.cols()) =
        motion(Vector6::Unit(k)).topRows<3>() * places;
  }
  return out;
}

Matrix NodalMotion::Phi() const { return columns(positions_); }

Matrix NodalMotion::P() const { return columns(first_moments_); }

Matrix NodalMotion::patterns() const {
  Matrix out = Matrix::Zero(num_dofs(), 6);
  for (Index k = 0; k < 6; ++k) add_pattern_load(Vector6::Unit(k), out.col(k));
  return out;
}

Matrix NodalMotion::first_moments() const {
  Matrix out = Matrix::Zero(num_dofs(), 9);
  for (Index a = 0; a < 3; ++a) {
    for (Index b = 0; b < 3; ++b) {
      Eigen::Map<Eigen::Matrix3Xd>(out.col(3 * a + b).data(), 3, positions_.cols()).row(b) =
          first_moments_.row(a);
    }
  }
  return out;
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
