// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/lowest_frequency.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kMostSolves = 24;
constexpr double kSettled = 1e-3;
constexpr double kNothingNew = 1e-10;

/// A smooth displacement field without symmetry: quadratic in the coordinates.
Eigen::Vector3d field(const Eigen::Vector3d& p) {
  const double x = p.x();
  const double y = p.y();
  const double z = p.z();
  return {0.31 * x * x + 0.83 * y * y - 0.71 * z * z + 0.37 * x * y + 0.2 * x,
          0.97 * x * x - 0.29 * y * y + 0.61 * z * z + 0.43 * x * z - 0.3 * y,
          -0.89 * x * x + 0.53 * y * y + 0.23 * z * z + 0.67 * x * y + 0.1 * z};
}

Vector start_shape(const body::FlexiblePart& part, BodyStepOperator& op) {
  Vector x = Vector::Zero(part.num_dofs());
  constexpr double kSide = 0.5;  // of central differences, exact for a quadratic field
  for (std::size_t node = 0; node < part.fe.nodes.size(); ++node) {
    const Eigen::Vector3d p = part.fe.nodes[node].position - part.fe.shape.com;
    Eigen::Matrix3d gradient;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = kSide * Eigen::Vector3d::Unit(k);
      gradient.col(k) = field(p + step) - field(p - step);
    }
    Eigen::Matrix<double, 6, 1> u;
    u << field(p), 0.5 * (gradient(2, 1) - gradient(1, 2)), 0.5 * (gradient(0, 2) - gradient(2, 0)),
        0.5 * (gradient(1, 0) - gradient(0, 1));
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = part.fe.dofs.node_dofs[node][k];
      if (dof >= 0 && dof < x.size()) x[dof] = u[static_cast<Eigen::Index>(k)];
    }
  }
  if (x.isZero(0.0)) x.setOnes();
  part.sieve.apply(x);
  x = part.fe.M * x;
  op.solve(x);
  return x;
}

/// Lowest ω of K z = ω² M z in the span of M-orthonormal vectors. @param K their projection of K
double lowest(const Matrix& K) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(K, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
}

}  // namespace

double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op) {
  if (part.num_dofs() <= part.sieve.rank()) return 0.0;
  std::vector<Vector> basis;  // M-orthonormal
  std::vector<Vector> mass_images;
  Matrix K(0, 0);
  Vector x = start_shape(part, op);
  double omega = 0;
  int settled = 0;
  for (int k = 0; k < kMostSolves; ++k) {
    const double before_norm = std::sqrt(x.dot(part.fe.M * x));
    // Twice is enough to be orthogonal to rounding.
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t i = 0; i < basis.size(); ++i) x -= mass_images[i].dot(x) * basis[i];
      part.sieve.apply(x);
    }
    Vector Mx = part.fe.M * x;
    const double norm = std::sqrt(x.dot(Mx));
    // Nothing new: the vectors so far span all that the start can reach.
    if (!(norm > kNothingNew * before_norm) || !std::isfinite(norm)) break;
    basis.push_back(x / norm);
    mass_images.push_back(Mx / norm);
    const Vector Kx = part.fe.K * basis.back();
    K.conservativeResize(k + 1, k + 1);
    for (int i = 0; i <= k; ++i) {
      K(i, k) = K(k, i) = basis[static_cast<std::size_t>(i)].dot(Kx);
    }
    const double before = omega;
    omega = lowest(K);
    settled = std::abs(omega - before) <= kSettled * omega ? settled + 1 : 0;
    if (settled == 3 || k + 1 == static_cast<int>(part.num_dofs() - part.sieve.rank())) break;
    x = mass_images.back();
    op.solve(x);
  }
  return omega;
}

}  // namespace buckens::stepping
