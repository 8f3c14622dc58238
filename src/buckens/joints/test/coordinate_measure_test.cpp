// SPDX-License-Identifier: Apache-2.0
// Ways along curves, swings and twists against differences, and against what is known of them.
#include "buckens/joints/coordinate_measure.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/joints/path_coordinate.h"
#include "buckens/joints/rolled_way.h"
#include "buckens/joints/swing_twist.h"
#include "buckens/joints/turning_rate.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::MarkerPath;

constexpr double kFullTurn = 2 * std::numbers::pi;

std::vector<Vector3d> points_of_helix() {
  std::vector<Vector3d> out;
  for (int k = 0; k <= 60; ++k) {
    const double a = 0.1 * k;
    out.emplace_back(0.8 * std::cos(a), 0.8 * std::sin(a), 0.3 * a);
  }
  return out;
}

/// Rate and acceleration of a coordinate along two paths, by its row and by differences.
void compare(const CoordinateMeasure& measure, const MarkerPath& F, const MarkerPath& M) {
  const auto value = [&](double t) { return measure.look(F.at(t), M.at(t), nullptr).fraction; };
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  const CoordinateLook look = measure.look(F.at(0), M.at(0), nullptr);
  const double rate = look.J.dot(V);
  EXPECT_NEAR(look.rate, rate, 1e-13 * (1 + std::abs(rate)));  // rounding
  // Differences of fourth order: h⁴ with h = 1 ms, and rounding over h.
  EXPECT_NEAR(rate, test::derivative(value), 1e-9 * (1 + std::abs(rate)));
  const double acceleration = look.J.dot(A) + measure.bias(F.at(0), M.at(0), {}, {}, nullptr);
  // The same, with rounding over h².
  EXPECT_NEAR(acceleration, test::second_derivative(value), 1e-7 * (1 + std::abs(acceleration)));
  // Accelerations of the markers enter the bias as they do the row.
  EXPECT_NEAR(acceleration, measure.bias(F.at(0), M.at(0), {F.alpha, F.a}, {M.alpha, M.a}, nullptr),
              1e-12 * (1 + std::abs(acceleration)));
}

TEST(PathCoordinate, RatesAndAccelerationsAreThoseOfTheWay) {
  const auto curve = std::make_shared<SpaceCurve>(points_of_helix(), false);
  const MarkerPath F = MarkerPath::some(1);
  MarkerPath M = MarkerPath::some(2);
  for (const Vector3d& across : {Vector3d(Vector3d::Zero()), Vector3d(Vector3d::UnitZ())}) {
    const PathCoordinate way(curve, across, {0.8, 0, 0});
    // On the curve, between two points of the spline: derivatives of any order are there.
    const double u = curve->knots()[20] + 0.4 * (curve->knots()[21] - curve->knots()[20]);
    M.p = F.p + F.R * curve->at(u).p;
    M.v = 0.3 * M.v;  // so that differences do not reach other pieces
    compare(way, F, M);
    // Beside it rates are exact, too.
    const MarkerPath beside = [&] {
      MarkerPath out = M;
      out.p += Vector3d(0.05, -0.03, 0.04);
      return out;
    }();
    const auto value = [&](double t) { return way.look(F.at(t), beside.at(t), nullptr).fraction; };
    EXPECT_NEAR(way.look(F.at(0), beside.at(0), nullptr).rate, test::derivative(value, 1e-4), 1e-7);
  }
}

TEST(PathCoordinate, MeasuresLengthsOfSplinesAsFineChordsDo) {
  const auto curve = std::make_shared<SpaceCurve>(points_of_helix(), false);
  const PathCoordinate way(curve, Vector3d::Zero(), {0.8, 0, 0});
  // A hundred chords per piece; those of h miss κ² h²/24 of the length, which Richardson removes.
  const auto chords = [&](int parts) {
    double out = 0;
    for (std::size_t k = 1; k < curve->knots().size(); ++k) {
      Vector3d last = curve->at(curve->knots()[k - 1]).p;
      for (int j = 1; j <= parts; ++j) {
        const double u =
            curve->knots()[k - 1] + (curve->knots()[k] - curve->knots()[k - 1]) * j / parts;
        out += (curve->at(u).p - last).norm();
        last = curve->at(u).p;
      }
    }
    return out;
  };
  const double exact = (4 * chords(200) - chords(100)) / 3;
  EXPECT_NEAR(way.lap(), exact, 1e-12 * exact);  // κ⁴ h⁴ of some 1e-13, and rounding
  // That of the helix but for the spline's error of h⁴.
  EXPECT_NEAR(way.lap(), 6.0 * std::hypot(0.8, 0.3), 2e-4);
  // Beyond its ends the curve goes on straight.
  EXPECT_NEAR(way.way(curve->length() + 0.1) - way.lap(),
              0.1 * curve->at(curve->length()).tangent.norm(), 1e-12);
}

/// Around a circle of two arcs: laps add up, forwards and back.
TEST(PathCoordinate, CountsLaps) {
  const auto arc = CurveStep::Kind::arc_through;
  const std::vector<CurveStep> steps = {{arc, {-0.2, 0, 0}, {0, 0.2, 0}},
                                        {arc, {0.2, 0, 0}, {0, -0.2, 0}}};
  const auto curve = std::make_shared<SpaceCurve>(CurvePieces({0.2, 0, 0}, steps), true);
  const PathCoordinate way(curve, Vector3d::UnitZ(), {0, 0.2, 0});
  EXPECT_NEAR(way.lap(), 0.2 * kFullTurn, 1e-15);
  spatial::MarkerMotion F, M;
  CountedValue now;
  for (const double sign : {1.0, -1.0}) {
    now = {};
    for (int k = 1; k <= 40; ++k) {
      const double turned = sign * 0.5 * k;
      M.p = 0.2 * Vector3d(-std::sin(turned), std::cos(turned), 0);
      now.fraction = way.look(F, M, &now).fraction;
      EXPECT_NEAR(now.fraction, 0.2 * turned, 1e-14);  // rounding
    }
    // Without a past it is within half a lap.
    EXPECT_NEAR(way.look(F, M, nullptr).fraction, std::remainder(sign * 4.0, 0.2 * kFullTurn),
                1e-14);
  }
}

/// Away from the curve it is the nearest place, in the lap of the step before.
TEST(PathCoordinate, FindsPointsAgainThatWereLetGo) {
  const auto curve = std::make_shared<SpaceCurve>(
      CurvePieces({0.2, 0, 0}, {{CurveStep::Kind::arc_through, {-0.2, 0, 0}, {0, 0.2, 0}},
                                {CurveStep::Kind::arc_through, {0.2, 0, 0}, {0, -0.2, 0}}}),
      true);
  const PathCoordinate way(curve, Vector3d::UnitZ(), {0.2, 0, 0});
  spatial::MarkerMotion F, M;
  CountedValue now{0, 2 * way.lap()};
  for (const double r : {0.35, 0.21, 0.1, 0.2}) {
    M.p = r * Vector3d(std::cos(2.5), std::sin(2.5), 0);
    now.fraction = way.look(F, M, &now).fraction;
    EXPECT_NEAR(now.fraction, 2 * way.lap() + 0.2 * 2.5, 1e-14) << r;
  }
  M.p.setZero();
  EXPECT_TRUE(way.look(F, M, &now).J.allFinite());
}

TEST(PathCoordinate, KeepsItsBranchWhereACurveCrossesItself) {
  std::vector<Vector3d> eight;
  for (int k = 0; k < 64; ++k) {
    const double a = kFullTurn * (k + 0.5) / 64;
    eight.emplace_back(std::sin(a), std::sin(a) * std::cos(a), 0);
  }
  const auto curve = std::make_shared<SpaceCurve>(eight, true);
  const PathCoordinate way(curve, Vector3d::UnitZ(), eight.front());
  spatial::MarkerMotion F, M;
  CountedValue now;
  const double step = curve->length() / 300;
  for (int k = 1; k <= 600; ++k) {
    M.p = curve->at(k * step).p;
    const double before = now.fraction;
    now.fraction = way.look(F, M, &now).fraction;
    EXPECT_NEAR(now.fraction - before, step, 0.02 * step) << k;  // |c′| is nearly one
  }
  EXPECT_NEAR(now.fraction, 2 * way.lap(), 1e-12);
}

TEST(Swing, RatesAndAccelerationsAreThoseOfTheAngle) {
  const Vector3d a = Vector3d(1, 2, -2) / 3.0, b = Vector3d(2, 1, 2) / 3.0;
  for (const int seed : {2, 3, 4}) {
    const MarkerPath F = MarkerPath::some(1), M = MarkerPath::some(seed);
    compare(Swing(a, b), F, M);
    compare(Twist(a, b, spatial::exp_rotation({0.2, -0.4, 0.1}).toRotationMatrix()), F, M);
  }
}

TEST(Swing, HasTheDirectionInWhichItParts) {
  const Swing swing(Vector3d::UnitZ(), Vector3d::UnitZ());
  spatial::MarkerMotion F, M;
  M.w = {3, 4, 7};
  CoordinateLook look = swing.look(F, M, nullptr);
  EXPECT_EQ(look.fraction, 0);
  EXPECT_NEAR(look.rate, 5, 1e-14);  // the part of ω across the axis
  EXPECT_NEAR(look.J[6], 0.6, 1e-14);
  EXPECT_NEAR(swing.bias(F, M, {}, {{1, 0, 0}, {}}, nullptr), 0.6, 1e-14);
  M.R = spatial::exp_rotation({std::numbers::pi, 0, 0}).toRotationMatrix();
  look = swing.look(F, M, nullptr);
  EXPECT_NEAR(look.fraction, std::numbers::pi, 1e-15);
  EXPECT_NEAR(look.rate, -5, 1e-14);  // closing
  M.w.setZero();
  M.R.setIdentity();
  look = swing.look(F, M, nullptr);
  EXPECT_EQ(look.rate, 0);
  EXPECT_NEAR(look.J.segment<3>(6).norm(), 1, 1e-14);
  EXPECT_EQ(look.J[8], 0);
  // A hair beside it, the rate by the row is that of the angle.
  M.R = spatial::exp_rotation({1e-9, 0, 0}).toRotationMatrix();
  M.w = {0.5, 0, 0};
  look = swing.look(F, M, nullptr);
  EXPECT_NEAR(look.fraction, 1e-9, 1e-16);
  EXPECT_NEAR(look.rate, 0.5, 1e-6);  // its direction is known to rounding over the angle
}

/// What is put together from a swing and a twist comes apart into them.
TEST(Twist, IsWhatTheSwingLeaves) {
  const Vector3d a = Vector3d(1, 2, -2) / 3.0, b = Vector3d(2, 1, 2) / 3.0;
  const Matrix3d placed = spatial::exp_rotation(Vector3d(0.2, -0.4, 0.1)).toRotationMatrix();
  const Twist twist(a, b, placed);
  const Swing swing(a, placed.transpose() * b);
  const Matrix3d bent = spatial::rotation_between(a, b).toRotationMatrix();
  spatial::MarkerMotion F, M;
  F.R = spatial::exp_rotation(Vector3d(0.5, 0.3, -0.2)).toRotationMatrix();
  for (const double angle : {0.0, 0.4, 2.5}) {
    for (const double turn : {-2.9, -0.3, 0.0, 1.1, 3.0}) {
      const Vector3d u = a.unitOrthogonal();
      const Matrix3d swung = spatial::exp_rotation(angle * u).toRotationMatrix();
      const Matrix3d turned = spatial::exp_rotation(turn * a).toRotationMatrix();
      M.R = F.R * swung * turned * bent.transpose() * placed;
      EXPECT_NEAR(swing.look(F, M, nullptr).fraction, angle, 1e-14);
      EXPECT_NEAR(twist.look(F, M, nullptr).fraction, turn, 1e-14);
    }
  }
  M.R = F.R * placed;
  EXPECT_NEAR(twist.look(F, M, nullptr).fraction, 0, 1e-15);
  EXPECT_NEAR(swing.look(F, M, nullptr).fraction, std::acos(a.dot(b)), 1e-14);
}

RollingRow::Data leaning_wheel() {
  RollingRow::Data data;
  data.normal_F = Vector3d(0.2, -0.1, 0.9).normalized();
  data.axis_M = Vector3d(0.1, 0.8, 0.3).normalized();
  data.radius = 0.4;
  data.edge = 0.05;
  return data;
}

TEST(RolledWay, RatesAndAccelerationsAreThoseOfTheMark) {
  const MarkerPath F = MarkerPath::some(1);
  const MarkerPath M = MarkerPath::some(2);
  const Matrix3d placed = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).matrix();
  const RolledWay angle(leaning_wheel(), placed, true);
  const RolledWay way(leaning_wheel(), placed, false);
  compare(angle, F, M);
  compare(way, F, M);
  EXPECT_TRUE(angle.is_angle() && !way.is_angle());
  EXPECT_DOUBLE_EQ(way.look(F.at(0), M.at(0), nullptr).fraction,
                   0.4 * angle.look(F.at(0), M.at(0), nullptr).fraction);
  // Where it is known to have been, it is the next of all places that the wheel may have rolled to.
  const CountedValue before{0, 25.0};
  const double far = way.look(F.at(0), M.at(0), &before).fraction;
  EXPECT_LE(std::abs(far - 25.0), 0.5 * 0.4 * kFullTurn);
  const double turns = (far - way.look(F.at(0), M.at(0), nullptr).fraction) / (0.4 * kFullTurn);
  EXPECT_NEAR(turns, std::round(turns), 1e-12);  // rounding
}

/// It turns about its axle, about the normal, and leans: only the first of them rolls.
TEST(RolledWay, CountsNeitherTurningNorLeaning) {
  RollingRow::Data data;
  data.normal_F = Vector3d::UnitZ();
  data.axis_M = Vector3d::UnitY();
  const RolledWay angle(data, Matrix3d::Identity(), true);
  const auto turn = [](double by, const Vector3d& about) {
    return Eigen::AngleAxisd(by, about).matrix();
  };
  for (const double lean : {0.0, 0.6, -1.2}) {
    spatial::MarkerMotion F, M;
    M.R =
        turn(2.0, Vector3d::UnitZ()) * turn(lean, Vector3d::UnitX()) * turn(0.9, Vector3d::UnitY());
    EXPECT_NEAR(angle.look(F, M, nullptr).fraction, 0.9, 1e-14);  // rounding
  }
}

TEST(TurningRate, ChangesAsItsRowSays) {
  const TurningRate turning(Vector3d(2, -1, 2) / 3.0);
  const MarkerPath F = MarkerPath::some(3), M = MarkerPath::some(4);
  const auto rate = [&](double t) { return turning.look(F.at(t), M.at(t), nullptr).rate; };
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  const CoordinateLook look = turning.look(F.at(0), M.at(0), nullptr);
  EXPECT_EQ(look.fraction, 0.0);
  EXPECT_NEAR(look.rate, look.J.dot(V), 1e-14);
  const double acceleration = look.J.dot(A) + turning.bias(F.at(0), M.at(0), {}, {}, nullptr);
  // Differences of fourth order: h⁴ with h = 1 ms, and rounding over h.
  EXPECT_NEAR(acceleration, test::derivative(rate), 1e-9 * (1 + std::abs(acceleration)));
  EXPECT_NEAR(acceleration, turning.bias(F.at(0), M.at(0), {F.alpha, F.a}, {M.alpha, M.a}, nullptr),
              1e-13);
}

}  // namespace
}  // namespace buckens::joints
