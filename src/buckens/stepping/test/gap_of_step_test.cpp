// SPDX-License-Identifier: Apache-2.0
// When a gap closes within a step, and how fast.
#include "buckens/stepping/gap_of_step.h"

#include <cmath>

#include <gtest/gtest.h>

namespace buckens::stepping {
namespace {

TEST(GapOfStep, OfAConstantAccelerationIsExact) {
  // It falls 3 mm from rest with 10 m/s^2, in a step of 40 ms.
  const double h = 0.04, g = 10.0, height = 3e-3;
  const GapOfStep gap{height, 0.0, height - 0.5 * g * h * h, -g * h, h};
  const double s = gap.closes_at();
  EXPECT_NEAR(s * h, std::sqrt(2.0 * height / g), 1e-15);
  EXPECT_NEAR(gap.rate_at(s), -std::sqrt(2.0 * g * height), 1e-14);
  EXPECT_EQ(gap.likely_rate_at(s), gap.rate_at(s));
  EXPECT_FALSE(gap.begins_elsewhere());
}

TEST(GapOfStep, ThatJumpsToAnotherPlaceIsHardlyFasterThanAtItsEnds) {
  // It moves by 2.8 mm in 1 ms, where both ends have 1.5 m/s: more than twice as fast between.
  const GapOfStep gap{1.5e-3, -1.5, -1.3e-3, -1.5, 1e-3};
  const double s = gap.closes_at();
  EXPECT_LT(gap.rate_at(s), -3.0);
  EXPECT_NEAR(gap.likely_rate_at(s), -1.65, 1e-12);
}

}  // namespace
}  // namespace buckens::stepping
