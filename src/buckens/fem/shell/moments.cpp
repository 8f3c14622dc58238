// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/moments.h"

#include <Eigen/Geometry>

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr std::array<std::array<int, 2>, 6> kMomentPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

}  // namespace

ShellMoments::ShellMoments(const ShellElement& element, const Vector3d& origin) {
  const auto& [I0, I1, I2] = element.stiffness->inertia;
  const double e = element.offset;
  const std::array<double, 3> per_area = {I0, I1 + e * I0, I2 + 2 * e * I1 + e * e * I0};
  const Eigen::Index n = element.nodes.cols();
  products.fill(Products::Zero(n, n));
  with_translation = with_rotation = ShellVectors::Zero(3, n);
  for (const ShellRulePoint& at : shell_mass_rule(n)) {
    const ShellShape shape = shell_shape(n, at.r, at.s);
    const double area = at.weight * shell_area(element, shape);
    const double m0 = area * per_area[0], m1 = area * per_area[1], m2 = area * per_area[2];
    const Vector3d y = element.nodes * shape.N - origin;
    const Vector3d d = element.directors * shape.N;
    for (std::size_t k = 0; k < 3; ++k) {
      products[k] += area * per_area[k] * shape.N * shape.N.transpose();
    }
    with_translation += (m0 * y + m1 * d) * shape.N.transpose();
    with_rotation += (m1 * y + m2 * d) * shape.N.transpose();
    mass += m0;
    first += m0 * y + m1 * d;
    const Matrix3d mixed = y * d.transpose();
    second += m0 * y * y.transpose() + m1 * (mixed + mixed.transpose()) + m2 * d * d.transpose();
  }
}

ShellMatrix ShellMoments::second_moment(const ShellVectors& directors, std::size_t pair) const {
  const auto [a, b] = kMomentPairs[pair];
  const Eigen::Index n = directors.cols();
  ShellMatrix W = ShellMatrix::Zero(6 * n, 6 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3d left = directors.col(i).cross(Vector3d::Unit(a));
    for (Eigen::Index j = 0; j < n; ++j) {
      const Vector3d right = directors.col(j).cross(Vector3d::Unit(b));
      W.block<1, 3>(6 * i + a, 6 * j + 3) = products[1](i, j) * right.transpose();
      W.block<3, 1>(6 * i + 3, 6 * j + b) = products[1](i, j) * left;
      W.block<3, 3>(6 * i + 3, 6 * j + 3) = products[2](i, j) * left * right.transpose();
    }
  }
  return W;
}

}  // namespace buckens::fem
