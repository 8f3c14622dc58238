// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/lowest_frequency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kMostSolves = 100;
// Error of ω² at which the iteration ends, as a share.
constexpr double kSettled = 0.01;
// Vectors whose mass beyond the others is below this fraction add nothing.
constexpr double kNothingNew = 1e-10;

constexpr double kDependentVector = 1e-10;

/// Exponents of the monomials of degree 1 to 3.
std::vector<std::array<int, 3>> monomials() {
  std::vector<std::array<int, 3>> out;
  for (int degree = 1; degree <= 3; ++degree) {
    for (int i = degree; i >= 0; --i) {
      for (int j = degree - i; j >= 0; --j) out.push_back({i, j, degree - i - j});
    }
  }
  return out;
}

double value(const std::array<int, 3>& powers, const Vector3d& p) {
  return std::pow(p.x(), powers[0]) * std::pow(p.y(), powers[1]) * std::pow(p.z(), powers[2]);
}

Vector3d gradient(const std::array<int, 3>& powers, const Vector3d& p) {
  Vector3d out = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (powers[k] == 0) continue;
    std::array<int, 3> lower = powers;
    --lower[k];
    out[static_cast<Eigen::Index>(k)] = powers[k] * value(lower, p);
  }
  return out;
}

/// Displacements along `axis` by a monomial of the place, rotations by half their curl.
Vector field(const body::FlexiblePart& part, const std::array<int, 3>& powers, int axis) {
  const fem::FeModel& fe = part.fe;
  // Lengths of one keep high and low powers comparable.
  const double size = std::sqrt(0.5 * fe.shape.J0.trace() / fe.shape.mass);
  Vector out = Vector::Zero(part.num_dofs());
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    const Vector3d p = (fe.nodes[node].position - fe.shape.com) / size;
    Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero();
    u[axis] = size * value(powers, p);
    u.tail<3>() = 0.5 * gradient(powers, p).cross(Vector3d::Unit(axis));
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = fe.dofs.node_dofs[node][k];
      if (dof >= 0 && dof < out.size()) out[dof] = u[static_cast<Eigen::Index>(k)];
    }
  }
  return out;
}

/// The combination of vectors with the least Rayleigh quotient. @param M, K their projections
Vector least_combination(const Matrix& M, const Matrix& K) {
  const Vector scale = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix> mass(scale.asDiagonal() * M * scale.asDiagonal());
  const auto kept = (mass.eigenvalues().array() > kNothingNew * mass.eigenvalues().maxCoeff());
  const auto rank = static_cast<Eigen::Index>(kept.count());
  if (rank == 0) return Vector::Zero(M.rows());
  const Matrix T = scale.asDiagonal() * mass.eigenvectors().rightCols(rank) *
                   mass.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> stiffness(T.transpose() * K * T);
  return T * stiffness.eigenvectors().col(0);
}

/// The best shape among polynomials of the place.
Vector smooth_shape(const body::FlexiblePart& part) {
  const auto powers = monomials();
  Matrix basis(part.num_dofs(), static_cast<Eigen::Index>(3 * powers.size()));
  Eigen::Index count = 0;
  for (const auto& monomial : powers) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector x = field(part, monomial, axis);
      const double before = x.norm();
      part.sieve.apply(x);
      // Of rigid motion only rounding is left.
      if (x.norm() > kDependentVector * before) basis.col(count++) = x;
    }
  }
  const auto kept = basis.leftCols(count);
  const Matrix M = kept.transpose() * (part.fe.M * kept);
  const Matrix K = kept.transpose() * (part.fe.K * kept);
  Vector out = kept * least_combination(M, K);
  part.sieve.apply(out);
  return out;
}

}  // namespace

double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op) {
  if (part.num_dofs() <= part.sieve.rank()) return 0.0;
  const linalg::SparseMatrix& M = part.fe.M;
  const linalg::SparseMatrix& K = part.fe.K;
  Matrix span(part.num_dofs(), 3);  // shape, correction, last way
  span.col(0) = smooth_shape(part);
  int columns = 1;
  double square = 0;
  for (int k = 0; k <= kMostSolves; ++k) {
    const auto vectors = span.leftCols(columns);
    const Matrix images_M = M * vectors;
    const Matrix images_K = K * vectors;
    Vector best = Vector::Ones(1);
    if (columns > 1) {
      best = least_combination(vectors.transpose() * images_M, vectors.transpose() * images_K);
    }
    const Vector x = vectors * best;
    const Vector Mx = images_M * best;
    const Vector Kx = images_K * best;
    const double mass = x.dot(Mx);
    if (!(mass > 0.0)) break;
    square = std::max(0.0, x.dot(Kx) / mass);
    if (k == kMostSolves) break;
    const Vector residual = Kx - square * Mx;
    Vector correction = residual;
    op.solve(correction);
    // ‖r‖² in the metric of M⁻¹, nearly: slow shapes see the mass part of the step matrix only.
    double stiffness = op.scheme().mass * mass + op.scheme().stiffness * x.dot(Kx);
    if (part.is_damped()) stiffness += op.scheme().damping * x.dot(part.C * x);
    const double error = residual.dot(correction) * stiffness / (mass * mass);
    if (!(error > kSettled * square * square)) break;
    if (columns > 1) {
      span.col(2) = vectors.rightCols(columns - 1) * best.tail(columns - 1);
      columns = 3;
    } else {
      columns = 2;
    }
    span.col(0) = x;
    span.col(1) = correction;
  }
  return std::sqrt(square);
}

}  // namespace buckens::stepping
