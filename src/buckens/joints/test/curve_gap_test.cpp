// SPDX-License-Identifier: Apache-2.0
// Gaps to curves of lines and arcs against differences and exact distances.
#include "buckens/joints/curve_gap.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "buckens/joints/joint_coordinate.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using Kind = CurveStep::Kind;
using test::MarkerPath;

constexpr double kPi = std::numbers::pi;

/// Two straights of 0.4 and two half circles of 0.1, counter-clockwise about z.
std::shared_ptr<const SpaceCurve> stadium() {
  const CurvePieces pieces({0, 0, 0}, {{Kind::line, {0.4, 0, 0}, {}},
                                       {Kind::smooth_arc, {0.4, 0.2, 0}, {}},
                                       {Kind::line, {0, 0.2, 0}, {}},
                                       {Kind::arc_through, {0, 0, 0}, {-0.1, 0.1, 0}}});
  return std::make_shared<SpaceCurve>(pieces, true);
}

double distance_to_stadium(const Vector3d& p) {
  const Vector3d spine(std::clamp(p.x(), 0.0, 0.4), 0.1, p.z());
  return (p - spine).norm() - 0.1;
}

TEST(CurvePieces, KnowTheirLengthsPlacesAndCurvatures) {
  const auto curve = stadium();
  EXPECT_NEAR(curve->length(), 0.8 + 0.2 * kPi, 1e-15);
  for (int k = 0; k < 200; ++k) {
    const double s = curve->length() * k / 200;
    const CurvePoint at = curve->at(s);
    EXPECT_NEAR(distance_to_stadium(at.p), 0, 1e-15);
    EXPECT_NEAR(at.tangent.norm(), 1, 1e-15);
    EXPECT_NEAR(at.tangent.dot(at.curvature), 0, 1e-14);
    const bool is_arc = at.p.x() < -1e-9 || at.p.x() > 0.4 + 1e-9;
    if (is_arc) {
      EXPECT_NEAR(at.curvature.norm(), 10, 1e-12);
    }
    const Vector3d ahead = curve->at(s + 1e-6).p - curve->at(s - 1e-6).p;
    EXPECT_NEAR((ahead / 2e-6 - at.tangent).norm(), 0, 1e-5);
  }
  EXPECT_TRUE(CurveGap::encloses_left(*curve, Vector3d::UnitZ()));
  EXPECT_FALSE(CurveGap::encloses_left(*curve, -Vector3d::UnitZ()));
}

TEST(CurvePieces, ArcsAreTheSameHoweverTheyAreGiven) {
  const Vector3d start(0, -1, 0);
  const Vector3d from(0, 0, 0);
  const Vector3d to(0.3, 0.4, 0.1);
  const CurvePieces smooth(start, {{Kind::line, from, {}}, {Kind::smooth_arc, to, {}}});
  const Vector3d middle = smooth.at(0.5 * (1 + smooth.length())).p;
  const auto& arc = smooth.all()[1];
  const CurvePieces through(from, {{Kind::arc_through, to, middle}});
  const CurvePieces about(from, {{Kind::arc_about, to, arc.origin}});
  for (const CurvePieces* other : {&through, &about}) {
    EXPECT_NEAR(other->length(), smooth.length() - 1, 1e-14);
    EXPECT_NEAR(other->all()[0].radius, arc.radius, 1e-14);
    EXPECT_NEAR((other->at(other->length()).p - to).norm(), 0, 1e-15);
    EXPECT_NEAR((other->at(0).tangent - Vector3d::UnitY()).norm(), 0, 1e-14);
  }
}

TEST(CurveGap, IsTheDistanceFromEverywhere) {
  CurveGap::Data data;
  data.is_on_left = false;
  data.radius = 0.03;
  const CurveGap outside(stadium(), data);
  data.is_on_left = true;
  const CurveGap inside(stadium(), data);
  for (int k = 0; k < 400; ++k) {
    spatial::MarkerMotion F, M;
    M.p = {-0.3 + 0.05 * (k % 20) + 0.001, -0.21 + 0.03 * (k / 20), 0.5};
    Vector3d flat = M.p;
    flat.z() = 0;
    // Not where two places are about as near: on the spine.
    if (distance_to_stadium(flat) < -0.098) continue;
    EXPECT_NEAR(outside.gap(F, M), distance_to_stadium(flat) - 0.03, 1e-13) << M.p.transpose();
    EXPECT_NEAR(inside.gap(F, M), -distance_to_stadium(flat) - 0.03, 1e-13) << M.p.transpose();
  }
}

TEST(CurveGap, RatesAndAccelerationsAreThoseOfTheGap) {
  const MarkerPath F = MarkerPath::some(1);
  const MarkerPath M = MarkerPath::some(2);
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  CurveGap::Data data;
  data.normal_F = {0.1, 0.2, 2.0};
  const Vector3d n = data.normal_F.normalized();
  const Vector3d x = n.unitOrthogonal();
  const Vector3d y = n.cross(x);
  const CurvePieces circle(
      0.3 * x, {{Kind::arc_through, -0.3 * x, 0.3 * y}, {Kind::smooth_arc, 0.3 * x, {}}});
  for (const bool left : {false, true}) {
    data.is_on_left = left;
    const JointCoordinate gap = JointCoordinate::gap(
        std::make_shared<CurveGap>(std::make_shared<SpaceCurve>(circle, true), data));
    const auto g = [&](double t) { return gap.fraction(F.at(t), M.at(t)); };
    const spatial::PairRow J = gap.derivatives(F.at(0), M.at(0));
    // Fourth-order differences over 1e-3 of quantities of one.
    EXPECT_NEAR(J.dot(V), test::derivative(g), 1e-8);
    EXPECT_NEAR(J.dot(A) + gap.bias(F.at(0), M.at(0), {}, {}), test::second_derivative(g), 1e-5);
  }
}

}  // namespace
}  // namespace buckens::joints
