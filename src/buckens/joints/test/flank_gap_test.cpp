// SPDX-License-Identifier: Apache-2.0
// Ways left to flanks of gears and racks against differences, and the spaces that they are in.
#include "buckens/joints/flank_gap.h"

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/joints/placed_mesh.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;

const MarkerPath kPinion = MarkerPath::some(1);
const MarkerPath kWheel = MarkerPath::some(2);
// Involutes are steep near their base circles: truncation h⁴ times fifth derivatives is 2e-10.
constexpr double kSmall = 2e-4;

/// Wheels in general position, as no bearing would let them.
Placement placed(bool internal) {
  Placement out;
  out.R_WF = kPinion.at(0).R;
  out.R_WM = kWheel.at(0).R;
  out.r_F = out.R_WF.transpose() * (kWheel.at(0).p - kPinion.at(0).p);
  out.axis_F = Vector3d(0.2, -0.7, 0.4).normalized();
  out.sizes = {13, 41};
  out.same_sense = internal;
  out.second_axis_F = out.axis_F.unitOrthogonal();
  out.pressure_angle = 0.35;
  out.helix_angle = 0.2;
  return out;
}

void compare_with_differences(const JointCoordinate& gap, const std::string& name) {
  const auto value = [&](double t) { return gap.look(kPinion.at(t), kWheel.at(t)).fraction; };
  Eigen::Matrix<double, 12, 1> V, A;
  V << kPinion.w, kPinion.v, kWheel.w, kWheel.v;
  A << kPinion.alpha, kPinion.a, kWheel.alpha, kWheel.a;
  const CoordinateLook look = gap.look(kPinion.at(0), kWheel.at(0));
  EXPECT_NEAR(look.J.dot(V), test::derivative(value, kSmall), 1e-9) << name;
  EXPECT_NEAR(look.rate, look.J.dot(V), 1e-13 * (1 + std::abs(look.rate))) << name;
  const double bias = gap.bias(kPinion.at(0), kWheel.at(0), {}, {});
  // Rounding ε/h².
  EXPECT_NEAR(look.J.dot(A) + bias, test::second_derivative(value, kSmall), 1e-6) << name;
}

TEST(FlankGap, RatesAndAccelerationsAreThoseOfTheGap) {
  for (const auto& [name, type, internal] :
       {std::tuple("gear", JointType::gear, false), std::tuple("ring", JointType::gear, true),
        std::tuple("rack", JointType::rack, false)}) {
    Placement placement = placed(internal);
    if (type == JointType::rack) placement.sizes = {0.3, 0.3};
    for (const JointCoordinate& gap : make_flank_gaps(type, placement, 1e-3).gaps) {
      compare_with_differences(gap, name);
    }
  }
}

/// Gears with 20 and 40 teeth and axes along z, 0.3 m apart.
struct GearsInPlay {
  Placement placement;
  spatial::MarkerMotion F, M;

  GearsInPlay() {
    placement.r_F = {0.3, 0, 0};
    placement.sizes = {20, 40};
    placement.pressure_angle = std::numbers::pi / 9;
    turn(0, 0, 0.3);
  }
  void turn(double first, double second, double distance) {
    F.R = Eigen::AngleAxisd(first, Vector3d::UnitZ()).toRotationMatrix();
    M.R = Eigen::AngleAxisd(second, Vector3d::UnitZ()).toRotationMatrix();
    M.p = {distance, 0, 0};
  }
};

TEST(FlankGap, BothShareThePlay) {
  GearsInPlay gears;
  const FlankGaps flanks = make_flank_gaps(JointType::gear, gears.placement, 1e-3);
  const double j = 1e-3 * std::cos(std::numbers::pi / 9);
  EXPECT_NEAR(flanks.play, j, 1e-18);
  const auto gap = [&](std::size_t k) { return flanks.gaps[k].look(gears.F, gears.M).fraction; };
  EXPECT_NEAR(gap(0), j / 2, 1e-16);
  EXPECT_NEAR(gap(1), j / 2, 1e-16);
  // The first wheel of 0.1 m goes on by a quarter of the play.
  gears.turn(0.25e-3 / 0.1, 0, 0.3);
  EXPECT_NEAR(gap(0), j / 4, 1e-15);
  EXPECT_NEAR(gap(1), 3 * j / 4, 1e-15);
  // Centres that part by a little open both by the sine of the pressure angle: the second order is
  // d² times half the slope of the sine, cos²α/(C sin α), 1e-10 over 0.1 m here.
  gears.turn(0, 0, 0.3 + 1e-5);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_NEAR(gap(k), j / 2 + 1e-5 * std::sin(std::numbers::pi / 9), 1e-9);
  }
}

TEST(FlankGap, IsThatOfTheSpaceInWhichTeethStand) {
  GearsInPlay gears;
  const FlankGaps flanks = make_flank_gaps(JointType::gear, gears.placement, 1e-3);
  const double pitch = 2 * std::numbers::pi / 20;  // of the first wheel
  const double half = flanks.play / 2;
  for (const int teeth : {-7, 1, 3, 46}) {
    gears.turn(teeth * pitch + 1e-3, 0, 0.3);
    const double way = 1e-3 * 0.1 * std::cos(std::numbers::pi / 9);
    // Rounding of angles of 15 rad, at 0.1 m.
    EXPECT_NEAR(flanks.gaps[0].look(gears.F, gears.M).fraction, half - way, 1e-15) << teeth;
    EXPECT_NEAR(flanks.gaps[1].look(gears.F, gears.M).fraction, half + way, 1e-15) << teeth;
  }
  // From where it was, it is followed beyond the middle of a tooth.
  CountedValue before{0, -0.4 * flanks.period};
  gears.turn(0.6 * pitch, 0, 0.3);
  EXPECT_NEAR(flanks.gaps[0].look(gears.F, gears.M, &before).fraction, half - 0.6 * flanks.period,
              1e-15);
  EXPECT_NEAR(flanks.gaps[0].look(gears.F, gears.M).fraction, half + 0.4 * flanks.period, 1e-15);
}

TEST(FlankGap, LeavesTeeth) {
  const GearsInPlay gears;
  // Half of 2π 0.1/20 m.
  EXPECT_NO_THROW(make_flank_gaps(JointType::gear, gears.placement, 15.7e-3));
  try {
    make_flank_gaps(JointType::gear, gears.placement, 15.8e-3);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("more than a space between teeth"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace buckens::joints
