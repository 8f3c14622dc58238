// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/shift_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/linalg/symmetric_eigen.h"
#include "buckens/linalg/tall_products.h"

namespace buckens::body {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

// Fields with less inertia than this share of the largest are taken as rigid or missing.
constexpr double kNoRotaryInertia = 1e-10;

/// A monomial of degree one or two and its gradient.
struct Monomial {
  double value;
  Vector3d gradient;
};

std::array<Monomial, 9> monomials(const Vector3d& x) {
  std::array<Monomial, 9> out;
  std::size_t k = 0;
  for (int i = 0; i < 3; ++i) {
    out[k++] = {x[i], Vector3d::Unit(i)};
    for (int j = i; j < 3; ++j) {
      out[k++] = {x[i] * x[j], x[j] * Vector3d::Unit(i) + x[i] * Vector3d::Unit(j)};
    }
  }
  return out;
}

/// The fields as nodal vectors, n×27.
Matrix smooth_fields(const fem::FeModel& fe) {
  double size = 0.0;
  for (const fem::Node& node : fe.nodes) {
    size = std::max(size, (node.position - fe.shape.com).norm());
  }
  Matrix out = Matrix::Zero(fe.M.rows(), 27);
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    const Vector3d x = (fe.nodes[node].position - fe.shape.com) / std::max(size, 1e-300);
    const std::array<Monomial, 9> all = monomials(x);
    for (int k = 0; k < 27; ++k) {
      const Monomial& f = all[static_cast<std::size_t>(k / 3)];
      const Vector3d direction = Vector3d::Unit(k % 3);
      const Vector3d rotation = 0.5 * f.gradient.cross(direction) / size;  // ½ curl
      for (int a = 0; a < 3; ++a) {
        const int u = fe.dofs.node_dofs[node][static_cast<std::size_t>(a)];
        const int r = fe.dofs.node_dofs[node][static_cast<std::size_t>(a + 3)];
        if (u >= 0) out(u, k) = f.value * direction[a];
        if (r >= 0) out(r, k) = rotation[a];
      }
    }
  }
  return out;
}

}  // namespace

double lowest_square_estimate(const FlexiblePart& part) {
  Matrix X = smooth_fields(part.fe);
  part.sieve.apply(X);
  const linalg::SymmetricEigen mass =
      linalg::symmetric_eigen(linalg::inner_products(X, linalg::symmetric_product(part.fe.M, X)));
  const double largest = mass.values[mass.values.size() - 1];
  if (!(largest > 0.0)) return 0.0;
  Eigen::Index first = 0;
  while (mass.values[first] < kNoRotaryInertia * largest) ++first;
  const Eigen::Index kept = X.cols() - first;
  const Matrix Z =
      mass.vectors.rightCols(kept) * mass.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Matrix strain = linalg::inner_products(X, linalg::symmetric_product(part.fe.K, X));
  return std::max(0.0, linalg::symmetric_eigenvalues(Z.transpose() * strain * Z)[0]);
}

}  // namespace buckens::body
