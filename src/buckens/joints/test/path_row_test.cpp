// SPDX-License-Identifier: Apache-2.0
// Points on curves against circles, helices and differences.
#include "buckens/joints/path_row.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;

constexpr double kHalfTurn = std::numbers::pi;

std::vector<Vector3d> points_on_circle(int count, double radius) {
  std::vector<Vector3d> out;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * kHalfTurn * k / count;
    out.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return out;
}

TEST(SpaceCurve, ClosesACircleToFourthOrder) {
  double before = 0;
  for (const int count : {16, 32, 64}) {
    const SpaceCurve curve(points_on_circle(count, 0.2), true);
    double error = 0;
    for (int k = 0; k < 1000; ++k) {
      error = std::max(error, std::abs(curve.at(curve.length() * k / 1000).p.norm() - 0.2));
    }
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 4.0, 0.1) << count;
    }
    before = error;
    // Smooth where it begins again.
    EXPECT_NEAR((curve.at(0).curvature - curve.at(curve.length() * (1 - 1e-12)).curvature).norm(),
                0, 1e-9);
  }
  EXPECT_LT(before,
            0.2 * std::pow(2 * kHalfTurn / 64, 4) / 300);  // 1/384 h⁴ of the fourth derivative
}

TEST(SpaceCurve, FindsTheNearestPointFromAnywhere) {
  const SpaceCurve curve(points_on_circle(48, 0.2), true);
  for (const double angle : {0.3, 2.0, -1.4}) {
    for (const double r : {0.15, 0.2, 0.4}) {
      const Vector3d place(r * std::cos(angle), r * std::sin(angle), 0.7);
      const SpaceCurve::Point at = curve.at(curve.nearest(place, Vector3d::UnitZ()));
      EXPECT_NEAR(at.tangent.dot(place - at.p), 0, 1e-13);
      EXPECT_NEAR(std::atan2(at.p.y(), at.p.x()), angle, 1e-5);
    }
  }
}

TEST(SpaceCurve, SaysWhatItCannotJoin) {
  const auto message = [](const std::vector<Vector3d>& points, bool closed) -> std::string {
    try {
      const SpaceCurve curve(points, closed);
    } catch (const ModelError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message({{0, 0, 0}}, false).find("has 1 points; a curve needs at least 2"),
            std::string::npos);
  EXPECT_NE(message({{0, 0, 0}, {1, 0, 0}}, true).find("a closed curve needs at least 3"),
            std::string::npos);
  EXPECT_NE(message({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, false).find("points 2 and 3"),
            std::string::npos);
  EXPECT_NE(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, true).find("points 4 and 1"),
            std::string::npos);
}

/// M moves along a helix of F, which moves as it likes; rows hold to the spline's error.
TEST(PathRow, RatesAndAccelerationsAreThoseOfTheResidual) {
  const MarkerPath F = MarkerPath::some(1);
  MarkerPath M = MarkerPath::some(2);
  std::vector<Vector3d> points;
  for (int k = 0; k <= 60; ++k) {
    const double a = 0.1 * k;
    points.emplace_back(0.8 * std::cos(a), 0.8 * std::sin(a), 0.3 * a);
  }
  const auto curve = std::make_shared<SpaceCurve>(points, false);
  // Off a plane curve everything is exact, whatever the gap is.
  const auto plane = make_path_rows(curve, Vector3d::UnitZ());
  ASSERT_EQ(plane.size(), 1U);
  const auto g = [&](double t) { return plane[0]->evaluate(F.at(t), M.at(t), 0, nullptr).g; };
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  const RowValue value = plane[0]->evaluate(F.at(0), M.at(0), 0, nullptr);
  // Third derivatives of a spline jump: h² of that at worst.
  EXPECT_NEAR(value.J.dot(V), test::derivative(g, 1e-4), 1e-9);
  const double bias = plane[0]->bias(F.at(0), M.at(0), {}, {}, 0, nullptr);
  // Fourth derivatives of a spline jump: differences know the second one to h² of that.
  EXPECT_NEAR(value.J.dot(A) + bias, test::second_derivative(g), 1e-4 * std::abs(bias));
  EXPECT_FALSE(plane[0]->turns_second());
}

TEST(PathRow, HoldsABeadOnAWireInSpace) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 60; ++k) {
    const double a = 0.1 * k;
    points.emplace_back(0.8 * std::cos(a), 0.8 * std::sin(a), 0.3 * a);
  }
  const auto rows = make_path_rows(std::make_shared<SpaceCurve>(points, false), std::nullopt);
  ASSERT_EQ(rows.size(), 2U);
  const double a = 2.345;
  spatial::MarkerMotion F, M;
  const Vector3d e(std::cos(a), std::sin(a), 0);
  const Vector3d t = Vector3d(-0.8 * std::sin(a), 0.8 * std::cos(a), 0.3).normalized();
  M.p = 0.8 * e + Vector3d(0, 0, 0.3 * a);
  M.v = 2.0 * t;
  Vector3d J[2];
  for (int k = 0; k < 2; ++k) {
    const RowValue value = rows[static_cast<std::size_t>(k)]->evaluate(F, M, 0, nullptr);
    EXPECT_NEAR(value.g, 0, 1e-6);  // of the spline, h⁴/384
    J[k] = value.J.segment<3>(9).transpose();
    EXPECT_NEAR(J[k].dot(t), 0, 1e-5);
    EXPECT_NEAR(J[k].norm(), 1, 1e-14);
    // Centripetal acceleration v² κ with κ = r/(r² + b²), towards the axis.
    const double bias = rows[static_cast<std::size_t>(k)]->bias(F, M, {}, {}, 0, nullptr);
    const Vector3d centripetal = -4.0 * 0.8 / (0.64 + 0.09) * e;
    // Second derivatives of a spline are known to h²/12.
    EXPECT_NEAR(bias, -J[k].dot(centripetal), 0.1 * 0.1 / 12 * centripetal.norm());
  }
  EXPECT_NEAR(J[0].dot(J[1]), 0, 1e-14);
  double states[2];
  M.p = points.back() + 0.1 * (points[60] - points[59]).normalized();
  EXPECT_THROW(rows[0]->follow(F, M, 0, 0, nullptr, states), NumericalError);
}

}  // namespace
}  // namespace buckens::joints
