// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/inertia_invariants.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::body {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

constexpr int kDofs = 7;
const Vector3d kW(0.8, -1.3, 0.5);
const Vector3d kWDot(-2.0, 0.7, 1.1);

/// A body of mass points, each displaced by g d with a full matrix g: everything by direct sums.
struct PointCloud {
  struct Point {
    double mass;
    Vector3d s0;
    Eigen::Matrix<double, 3, kDofs> g;
  };
  std::vector<Point> points;
  fem::ShapeIntegrals shape;

  PointCloud() {
    for (int k = 0; k < 12; ++k) {
      Point point;
      point.mass = 0.5 + 0.1 * k;
      for (int i = 0; i < 3; ++i) point.s0[i] = std::sin(1.0 + 2.3 * k + 1.7 * i);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < kDofs; ++j) point.g(i, j) = std::cos(0.4 * k + 1.9 * i + 2.7 * j);
      }
      points.push_back(point);
    }
    integrate();
  }

  void integrate() {
    constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    std::array<Matrix, 6> W;
    for (Matrix& w : W) w = Matrix::Zero(kDofs, kDofs);
    shape.c = Matrix::Zero(kDofs, 9);
    for (const Point& point : points) {
      shape.mass += point.mass;
      shape.C0 += point.mass * point.s0 * point.s0.transpose();
      for (std::size_t k = 0; k < 6; ++k) {
        W[k] += point.mass * point.g.row(kPairs[k][0]).transpose() * point.g.row(kPairs[k][1]);
      }
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          shape.c.col(3 * a + b) += point.mass * point.s0[a] * point.g.row(b).transpose();
        }
      }
    }
    shape.J0 = shape.C0.trace() * Matrix3d::Identity() - shape.C0;
    for (std::size_t k = 0; k < 6; ++k) shape.W[k] = W[k].sparseView();
  }

  Matrix3d J(const Vector& d) const {
    Matrix3d out = Matrix3d::Zero();
    for (const Point& p : points) {
      const Vector3d s = p.s0 + p.g * d;
      out += p.mass * (s.squaredNorm() * Matrix3d::Identity() - s * s.transpose());
    }
    return out;
  }
  /// Σ m (g x) × (g y)
  Vector3d cross(const Vector& x, const Vector& y) const {
    Vector3d out = Vector3d::Zero();
    for (const Point& p : points) out += p.mass * (p.g * x).cross(p.g * y);
    return out;
  }
  /// −Σ m gᵀ a with a the acceleration of a place moving by rate in a frame that turns
  Vector load(const Vector& d, const Vector& d_dot, bool with_s0) const {
    Vector out = Vector::Zero(kDofs);
    for (const Point& p : points) {
      const Vector3d s = p.g * d;
      Vector3d a = kW.cross(kW.cross(s)) + kWDot.cross(s) + 2.0 * kW.cross(p.g * d_dot);
      if (with_s0) a = kW.cross(kW.cross(p.s0));
      out -= p.mass * p.g.transpose() * a;
    }
    return out;
  }
};

class Invariants : public testing::Test {
 protected:
  Invariants() : invariants(cloud.shape), d(kDofs), d_dot(kDofs), d_ddot(kDofs) {
    for (int k = 0; k < kDofs; ++k) {
      d[k] = 0.3 * std::sin(1.0 + k);
      d_dot[k] = std::cos(2.0 * k);
      d_ddot[k] = 2.0 * std::sin(0.5 + 3.0 * k);
    }
  }
  PointCloud cloud;
  InertiaInvariants invariants;
  Vector d, d_dot, d_ddot;
};

// Tolerances: a few hundred products of numbers of order ten, 1e-13 of the result.

TEST_F(Invariants, RotaryInertiaIsThatOfTheMovedMasses) {
  const Matrix3d expected = cloud.J(d);
  EXPECT_LE((invariants.rotary_inertia(d) - expected).norm(), 1e-13 * expected.norm());
  EXPECT_LE((invariants.moments(d, d_dot, d_ddot).J - expected).norm(), 1e-13 * expected.norm());
}

TEST_F(Invariants, RateOfTheRotaryInertia) {
  const Matrix3d expected = test::derivative(
      [&](double t) { return cloud.J(d + t * d_dot); });  // a quadratic: exact but for rounding
  const Matrix3d found = invariants.moments(d, d_dot, d_ddot).J_dot;
  EXPECT_LE((found - expected).norm(), 1e-11 * expected.norm());
}

TEST_F(Invariants, RelativeMomentumAndItsRate) {
  const Vector3d l = cloud.cross(d, d_dot);
  EXPECT_LE((invariants.relative_momentum(d, d_dot) - l).norm(), 1e-13 * l.norm());
  const DeformedMoments moments = invariants.moments(d, d_dot, d_ddot);
  EXPECT_LE((moments.l - l).norm(), 1e-13 * l.norm());
  // d/dt of d × ḋ: the part with ḋ × ḋ is zero.
  const Vector3d l_dot = cloud.cross(d, d_ddot);
  EXPECT_LE((moments.l_dot - l_dot).norm(), 1e-13 * l_dot.norm());
}

TEST_F(Invariants, LoadsAreThoseOfTheRelativeAccelerations) {
  const Vector expected = cloud.load(d, d_dot, false);
  const Vector found = invariants.deformation_load(d, d_dot, kW, kWDot);
  EXPECT_LE((found - expected).norm(), 1e-13 * expected.norm());
}

TEST_F(Invariants, CentrifugalLoadOfTheUndeformedBody) {
  const Vector expected = cloud.load(d, d_dot, true);
  const Vector found =
      invariants.centrifugal_patterns() * InertiaInvariants::centrifugal_weights(kW);
  EXPECT_LE((found - expected).norm(), 1e-13 * expected.norm());
}

}  // namespace
}  // namespace buckens::body
