// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/inertia_invariants.h"

#include <utility>

#include "buckens/body/deformation_coupling.h"
#include "buckens/body/nodal_inertia.h"
#include "buckens/body/nodal_motion.h"
#include "buckens/body/second_moments.h"

namespace buckens::body {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

/// T_ab = xᵀ W_ab y for all nine pairs, from the stored six and the scalar mass matrix.
Matrix3d bilinear(const fem::ShapeIntegrals& shape, const Vector& x, const Vector& y) {
  Matrix3d T = Matrix3d::Zero();
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto [a, b] = kPairs[k];
    if (shape.W[k].nonZeros() == 0) continue;
    const Vector Wy = shape.W[k] * y;
    T(a, b) = x.dot(Wy);
    if (a == b) continue;
    const Vector Wx = shape.W[k] * x;
    T(b, a) = y.dot(Wx);
  }
  const NodalInertia nodal(shape.nodal);
  // The scalar mass matrix may have to come from other processes.
  if (nodal.empty() || x.isZero(0.0) || y.isZero(0.0)) return T;
  T += nodal.times_mass(x) * nodal.by_node(y).transpose();
  return T;
}

}  // namespace

InertiaInvariants::InertiaInvariants(const fem::ShapeIntegrals& shape) : shape_(&shape) {
  patterns_.resize(shape.c.rows(), 6);
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto [a, b] = kPairs[k];
    const auto column = static_cast<Eigen::Index>(k);
    patterns_.col(column) = shape.c.col(3 * a + b);
    if (a != b) patterns_.col(column) += shape.c.col(3 * b + a);
  }
}

void InertiaInvariants::keep_by_node(std::shared_ptr<const NodalMotion> motion) {
  by_node_ = std::move(motion);
  patterns_ = Matrix();
}

Matrix InertiaInvariants::centrifugal_patterns() const {
  return by_node_ ? by_node_->patterns() : patterns_;
}

Eigen::Matrix<double, 6, 1> InertiaInvariants::pattern_values(
    const Eigen::Ref<const Vector>& d) const {
  return by_node_ ? NodalMotion::patterns(by_node_->moments(d)) : patterns_.transpose() * d;
}

void InertiaInvariants::add_centrifugal_load(const Eigen::Matrix<double, 6, 1>& weights,
                                             Vector& load) const {
  if (by_node_) {
    by_node_->add_pattern_load(weights, load);
  } else {
    load.noalias() += patterns_ * weights;
  }
}

Matrix InertiaInvariants::first_moments() const {
  return by_node_ ? by_node_->first_moments() : shape_->c;
}

Matrix3d InertiaInvariants::rotary_inertia(const Vector& d) const {
  return shape_->J0 + linear_inertia(pattern_values(d)) + to_inertia(bilinear(*shape_, d, d));
}

Vector3d InertiaInvariants::relative_momentum(const Vector& d, const Vector& d_dot) const {
  return axial(bilinear(*shape_, d, d_dot));
}

Matrix3d InertiaInvariants::linear_inertia(const Eigen::Matrix<double, 6, 1>& z) {
  // S₁ + S₁ᵀ: the patterns of unlike indices are sums already.
  Matrix3d S;
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto [a, b] = kPairs[k];
    const double value = z[static_cast<Eigen::Index>(k)];
    S(a, b) = S(b, a) = a == b ? 2.0 * value : value;
  }
  return to_inertia(S);
}

DeformedMoments InertiaInvariants::moments(const Vector& d, const Vector& d_dot,
                                           const Vector& d_ddot) const {
  DeformedMoments out = quadratic_moments(d, d_dot, d_ddot);
  out.J += shape_->J0 + linear_inertia(pattern_values(d));
  out.J_dot += linear_inertia(pattern_values(d_dot));
  return out;
}

DeformedMoments InertiaInvariants::quadratic_moments(const Vector& d, const Vector& d_dot,
                                                     const Vector& d_ddot) const {
  Vector no_load;
  return evaluate_deformation(*shape_, d, d_dot, d_ddot, {}, no_load);
}

void InertiaInvariants::add_weighted(const Matrix3d& A, const Vector& x, Vector& y) const {
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto [a, b] = kPairs[k];
    const auto& W = shape_->W[k];
    if (W.nonZeros() == 0) continue;
    if (A(a, b) != 0.0) y.noalias() += A(a, b) * (W * x);
    if (a != b && A(b, a) != 0.0) y.noalias() += A(b, a) * (W.transpose() * x);
  }
  const NodalInertia nodal(shape_->nodal);
  if (!nodal.empty() && !A.isZero(0.0)) nodal.add(A * nodal.times_mass(x), y);
}

Vector InertiaInvariants::deformation_load(const Vector& d, const Vector& d_dot, const Vector3d& w,
                                           const Vector3d& w_dot, const CouplingTerms& kept) const {
  Vector load = Vector::Zero(d.size());
  const auto weights = DeformationWeights::of_motion(w, w_dot, kept);
  if (!weights.are_zero()) evaluate_deformation(*shape_, d, d_dot, d_dot, weights, load);
  return load;
}

Eigen::Matrix<double, 6, 1> InertiaInvariants::centrifugal_weights(const Vector3d& w) {
  const Matrix3d A = w.squaredNorm() * Matrix3d::Identity() - w * w.transpose();
  Eigen::Matrix<double, 6, 1> weights;
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    weights[static_cast<Eigen::Index>(k)] = A(kPairs[k][0], kPairs[k][1]);
  }
  return weights;
}

}  // namespace buckens::body
