// SPDX-License-Identifier: Apache-2.0
// Wheels on planes against differences and the velocity of their lowest place.
#include "buckens/joints/rolling_row.h"

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;
using Direction = RollingRow::Direction;

class Wheel : public ::testing::TestWithParam<double> {
 protected:
  RollingRow row(Direction direction) const {
    RollingRow::Data data;
    data.normal_F = Vector3d(0.2, -0.1, 0.9).normalized();
    data.axis_M = Vector3d(0.1, 0.8, 0.3).normalized();
    data.radius = 0.5;
    data.edge = GetParam();
    return RollingRow(data, direction);
  }
  static double rate(const RollingRow& row, const spatial::MarkerMotion& F,
                     const spatial::MarkerMotion& M) {
    Eigen::Matrix<double, 12, 1> V;
    V << F.w, F.v, M.w, M.v;
    return row.evaluate(F, M, 0, nullptr).J.dot(V);
  }
};

TEST_P(Wheel, RatesAndAccelerationsAreThoseOfTheContact) {
  const MarkerPath F = MarkerPath::some(1);
  const MarkerPath M = MarkerPath::some(2);
  Eigen::Matrix<double, 12, 1> A;
  A << F.alpha, F.a, M.alpha, M.a;
  for (const Direction direction : {Direction::normal, Direction::ahead, Direction::aside}) {
    const RollingRow own = row(direction);
    const RowValue value = own.evaluate(F.at(0), M.at(0), 0, nullptr);
    const double change = test::derivative([&](double t) { return rate(own, F.at(t), M.at(t)); });
    const double bias = own.bias(F.at(0), M.at(0), {}, {}, 0, nullptr);
    // Fourth-order differences over 1e-3 of quantities of one.
    EXPECT_NEAR(value.J.dot(A) + bias, change, 1e-7);
    EXPECT_EQ(own.holds_rates_only(), direction != Direction::normal);
    if (direction != Direction::normal) {
      EXPECT_EQ(value.g, 0.0);
      continue;
    }
    const auto g = [&](double t) { return own.evaluate(F.at(t), M.at(t), 0, nullptr).g; };
    EXPECT_NEAR(rate(own, F.at(0), M.at(0)), test::derivative(g), 1e-8);
  }
}

/// The height is that of the lowest of many places on the wheel's rim.
TEST_P(Wheel, TouchesByItsLowestPlace) {
  spatial::MarkerMotion F, M;
  M.p = {0.3, -0.2, 0.6};
  M.R = spatial::exp_rotation({0.5, 0.1, -0.3}).toRotationMatrix();
  const double g = row(Direction::normal).evaluate(F, M, 0, nullptr).g;
  const Vector3d n = Vector3d(0.2, -0.1, 0.9).normalized();
  const Vector3d a = M.R * Vector3d(0.1, 0.8, 0.3).normalized();
  const Vector3d u = a.unitOrthogonal();
  double least = 1e9;
  for (int k = 0; k < 100000; ++k) {
    const double angle = 2e-5 * M_PI * k;
    const Vector3d rim = std::cos(angle) * u + std::sin(angle) * a.cross(u);
    least = std::min(least, n.dot(M.p + (0.5 - GetParam()) * rim) - GetParam());
  }
  EXPECT_NEAR(g, least, 1e-9);  // 1e5 places: R (6e-5)²/8
}

INSTANTIATE_TEST_SUITE_P(Edges, Wheel, ::testing::Values(0.0, 0.1, 0.5));

TEST(RollingRow, RefusesAFlatWheel) {
  RollingRow::Data data;
  data.axis_M = Vector3d::UnitZ();
  const RollingRow row(data, Direction::normal);
  EXPECT_THROW(row.evaluate({}, {}, 0, nullptr), NumericalError);
}

}  // namespace
}  // namespace buckens::joints
