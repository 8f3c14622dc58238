// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/joint_coordinate.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/joints/swing_twist.h"
#include "buckens/spatial/rotation.h"

namespace buckens::joints {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(JointCoordinate, OneLookIsAllOfIt) {
  const Matrix3d placed = spatial::exp_rotation(Vector3d(0.2, -0.4, 0.1)).toRotationMatrix();
  const Vector3d axis = Vector3d(1, 2, -2) / 3.0, other = Vector3d(2, 1, 2) / 3.0;
  const spatial::MarkerMotion F{{0.1, 0.2, -0.3},
                                spatial::exp_rotation(Vector3d(0.5, 0.3, -0.2)).toRotationMatrix(),
                                {1.0, -2.0, 0.5},
                                {0.3, 0.1, -0.7}};
  const spatial::MarkerMotion M{{1.1, -0.4, 0.6},
                                spatial::exp_rotation(Vector3d(-1.2, 0.8, 2.1)).toRotationMatrix(),
                                {-0.4, 3.0, 0.2},
                                {-0.6, 0.9, 0.4}};
  Eigen::Matrix<double, 12, 1> V;
  V << F.w, F.v, M.w, M.v;
  for (const JointCoordinate& coordinate :
       {JointCoordinate::angle(axis, placed), JointCoordinate::first_angle(axis, other, placed),
        JointCoordinate::second_angle(axis, other, placed),
        JointCoordinate::displacement(axis, {0.3, 0.2, 0.1}), JointCoordinate::length(),
        JointCoordinate::measured(std::make_shared<Twist>(axis, other, placed))}) {
    const CoordinateLook look = coordinate.look(F, M);
    const int kind = static_cast<int>(coordinate.kind());
    EXPECT_EQ(look.fraction, coordinate.fraction(F, M)) << kind;
    EXPECT_EQ(look.J, coordinate.derivatives(F, M)) << kind;
    EXPECT_NEAR(look.rate, look.J.dot(V), 1e-14) << kind;  // rounding
    EXPECT_GT(std::abs(look.rate), 0.1) << kind;
  }
}

TEST(JointCoordinate, CountsSeveralTurnsInAStep) {
  const auto angle = JointCoordinate::angle(Vector3d::UnitZ(), Matrix3d::Identity());
  const auto slide = JointCoordinate::displacement(Vector3d::UnitZ(), Vector3d::Zero());
  for (const double rate : {20.0, -20.0, 3.0, 0.0}) {
    CountedValue now{0, 0, rate, 0};
    CountedValue there{0, 0, rate, 0};
    for (int k = 1; k <= 50; ++k) {
      const double fraction = std::remainder(rate * k, kTurn);
      now = angle.follow(angle.expect(now, k), fraction);
      EXPECT_NEAR(now.value(), rate * k, 1e-12);  // rounding of some 1000 rad
      there = slide.follow(slide.expect(there, k), fraction);
      EXPECT_EQ(there.value(), fraction);  // displacements have no turns
    }
  }
}

TEST(JointCoordinate, SaysWhereTurnsCannotBeCounted) {
  EXPECT_TRUE(spatial::is_countable({0, 0, 2.0, 1.0}, {0, 0, 5.1, 2.0}, kTurn));
  EXPECT_FALSE(spatial::is_countable({0, 0, 2.0, 1.0}, {0, 0, -1.2, 2.0}, kTurn));
  try {
    spatial::require_countable({0, 0, 2.0, 1.0}, {0, 0, 500.0, 1.1}, kTurn, "joint \"pin\"");
    FAIL();
  } catch (const StepTooLong& error) {
    EXPECT_STREQ(error.what(),
                 "joint \"pin\" goes from 2 to 500 rad/s within one step of 0.1 s, so that one "
                 "turn more or less could be meant; use a smaller step than that");
  }
}

}  // namespace
}  // namespace buckens::joints
