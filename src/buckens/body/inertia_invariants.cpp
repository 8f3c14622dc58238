// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/inertia_invariants.h"

#include "buckens/body/deformation_coupling.h"
#include "buckens/body/nodal_inertia.h"
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
  if (!nodal.empty()) T += nodal.times_mass(x) * nodal.by_node(y).transpose();
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

Matrix3d InertiaInvariants::rotary_inertia(const Vector& d) const {
  Matrix3d S1;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) S1(a, b) = shape_->c.col(3 * a + b).dot(d);
  }
  return shape_->J0 + to_inertia(S1 + S1.transpose() + bilinear(*shape_, d, d));
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
  out.J += shape_->J0 + linear_inertia(patterns_.transpose() * d);
  out.J_dot += linear_inertia(patterns_.transpose() * d_dot);
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
