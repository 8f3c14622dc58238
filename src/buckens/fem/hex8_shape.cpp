// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/hex8_shape.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

/// Calls visit(point, weight) at the n×n×n Gauss points.
template <std::size_t n, class Visitor>
void visit_gauss_points(const Hex8Corners& corners, const std::array<double, n>& places,
                        const std::array<double, n>& weights, Visitor&& visit) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        const Hex8Point point = hex8_point(corners, {places[i], places[j], places[k]});
        visit(point, weights[i] * weights[j] * weights[k] * point.volume);
      }
    }
  }
}

constexpr double kTwoPoints = 0.57735026918962576451;    // 1/√3
constexpr double kThreePoints = 0.77459666924148337704;  // √(3/5)

}  // namespace

const Eigen::Matrix<double, 3, 8>& hex8_signs() {
  static const Eigen::Matrix<double, 3, 8> signs = [] {
    Eigen::Matrix<double, 3, 8> s;
    s << -1, 1, 1, -1, -1, 1, 1, -1,  //
        -1, -1, 1, 1, -1, -1, 1, 1,   //
        -1, -1, -1, -1, 1, 1, 1, 1;
    return s;
  }();
  return signs;
}

Hex8Point hex8_point(const Hex8Corners& corners, const Vector3d& natural) {
  const auto& signs = hex8_signs();
  Hex8Point out;
  Eigen::Matrix<double, 3, 8> slope;  // ∂N/∂ξ
  for (int node = 0; node < 8; ++node) {
    const Vector3d s = signs.col(node);
    const Vector3d f = Vector3d::Ones() + s.cwiseProduct(natural);
    out.N[node] = 0.125 * f.x() * f.y() * f.z();
    slope.col(node) << s.x() * f.y() * f.z(), f.x() * s.y() * f.z(), f.x() * f.y() * s.z();
  }
  slope *= 0.125;
  const Eigen::Matrix3d jacobian = corners * slope.transpose();  // ∂x/∂ξ
  out.volume = jacobian.determinant();
  out.gradient = jacobian.inverse().transpose() * slope;
  return out;
}

double hex8_least_volume(const Hex8Corners& corners) {
  double least = hex8_point(corners, Vector3d::Zero()).volume;
  for (int node = 0; node < 8; ++node) {
    const Vector3d corner = hex8_signs().col(node);
    for (const double reach : {1.0, kTwoPoints}) {
      least = std::min(least, hex8_point(corners, reach * corner).volume);
    }
  }
  return least;
}

Eigen::Matrix<double, 6, 24> hex8_strain(const Hex8Point& point) {
  Eigen::Matrix<double, 6, 24> B = Eigen::Matrix<double, 6, 24>::Zero();
  for (int node = 0; node < 8; ++node) {
    const Vector3d g = point.gradient.col(node);
    auto block = B.middleCols<3>(3 * node);
    block.topRows<3>() = g.asDiagonal();
    block.row(3) << g.y(), g.x(), 0.0;
    block.row(4) << 0.0, g.z(), g.y();
    block.row(5) << g.z(), 0.0, g.x();
  }
  return B;
}

Eigen::Matrix<double, 6, 6> solid_elasticity(double E, double nu) {
  const double lame = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double shear = E / (2.0 * (1.0 + nu));
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  D.topLeftCorner<3, 3>().setConstant(lame);
  D.diagonal().head<3>().array() += 2.0 * shear;
  D.diagonal().tail<3>().setConstant(shear);
  return D;
}

Eigen::Matrix<double, 24, 24> hex8_stiffness(const Hex8Corners& corners,
                                             const Eigen::Matrix<double, 6, 6>& D) {
  Eigen::Matrix<double, 24, 24> K = Eigen::Matrix<double, 24, 24>::Zero();
  const auto add = [&](const Hex8Point& point, double weight) {
    const Eigen::Matrix<double, 6, 24> B = hex8_strain(point);
    const Eigen::Matrix<double, 6, 24> stress = weight * (D * B);
    K.noalias() += B.transpose() * stress;
  };
  visit_gauss_points<2>(corners, {-kTwoPoints, kTwoPoints}, {1.0, 1.0}, add);
  return 0.5 * (K + K.transpose());
}

Eigen::Matrix<double, 8, 8> hex8_volume_products(const Hex8Corners& corners) {
  Eigen::Matrix<double, 8, 8> products = Eigen::Matrix<double, 8, 8>::Zero();
  const auto add = [&](const Hex8Point& point, double weight) {
    products.noalias() += weight * point.N * point.N.transpose();
  };
  visit_gauss_points<3>(corners, {-kThreePoints, 0.0, kThreePoints},
                        {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}, add);
  return 0.5 * (products + products.transpose());
}

}  // namespace buckens::fem
