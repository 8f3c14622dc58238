// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/running_integral.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/base/time_law.h"

namespace buckens::base {
namespace {

TEST(RunningIntegral, IsExactForPolynomialsUpToTheDegreeOfTheRule) {
  // One panel of 15 Kronrod points is exact to degree 22; rounding of some forty panels.
  const RunningIntegral sum([](double t) { return 23 * std::pow(t, 22); });
  EXPECT_NEAR(sum.to(1.0), 1.0, 1e-13);
  EXPECT_NEAR(sum.to(0.5), std::pow(0.5, 23), 1e-13 * std::pow(0.5, 23));
}

TEST(RunningIntegral, FollowsOscillationsOverManyPeriods) {
  const RunningIntegral sum([](double t) { return std::cos(300 * t); });
  // 1e-13 of ∫|f|, which is about 0.64 t.
  for (const double t : {1e-6, 0.01, 1.0, 20.0}) {
    EXPECT_NEAR(sum.to(t), std::sin(300 * t) / 300, 1e-13 * (1 + t)) << t;
  }
}

TEST(RunningIntegral, TakesJumpsAndCorners) {
  const RunningIntegral jump([](double t) { return t > 0.3 ? 5.0 : 1.0; });
  // The jump is located to 1e-12 of its time.
  EXPECT_NEAR(jump.to(1.0), 0.3 + 3.5, 1e-11);
  const RunningIntegral corner([](double t) { return std::abs(t - 0.3); }, {0.3});
  EXPECT_NEAR(corner.to(1.0), 0.5 * (0.09 + 0.49), 1e-14);
}

TEST(RunningIntegral, GivesTheSameNumberInWhateverOrderItIsAsked) {
  const auto f = [](double t) { return std::exp(std::sin(17 * t)) + (t > 0.7 ? 1 : 0); };
  const RunningIntegral upwards(f), downwards(f);
  std::vector<double> times;
  for (int k = 1; k <= 40; ++k) times.push_back(0.031 * k);
  std::vector<double> values;
  for (const double t : times) values.push_back(upwards.to(t));
  for (std::size_t k = times.size(); k-- > 0;) EXPECT_EQ(downwards.to(times[k]), values[k]);
}

TEST(RunningIntegral, NeverLooksBeyondTheTimeAskedFor) {
  double latest = 0;
  const RunningIntegral sum([&](double t) {
    latest = std::max(latest, t);
    return 1.0 / (1.0 - t);  // has a pole at 1
  });
  EXPECT_NEAR(sum.to(0.9), std::log(10.0), 1e-12);
  EXPECT_LT(latest, 0.9);
}

TEST(TimeLaw, TheIntegralOfASpeedIsAnAngleWithThatRate) {
  const TimeLaw constant = TimeLaw::integral(TimeLaw::constant(150));
  EXPECT_EQ(constant.value(0.2), 150 * 0.2);
  EXPECT_EQ(constant.rate(0.2), 150);
  EXPECT_EQ(constant.acceleration(0.2), 0);
  EXPECT_FALSE(constant.is_constant());
  EXPECT_TRUE(TimeLaw::integral(TimeLaw::constant(0)).is_constant());
  const TimeLaw speed = TimeLaw::table({0, 1, 2}, {0, 4, 4}, Interpolation::linear);
  const TimeLaw angle = TimeLaw::integral(speed);
  EXPECT_NEAR(angle.value(0.5), 0.5, 1e-14);
  EXPECT_NEAR(angle.value(2.0), 6.0, 1e-13);
  EXPECT_EQ(angle.rate(0.5), speed.value(0.5));
  EXPECT_EQ(angle.acceleration(0.5), 4);
  EXPECT_TRUE(angle.corners().empty());  // its rate has no jump
  ASSERT_TRUE(angle.range().has_value());
  EXPECT_EQ(angle.range()->last, 2);
}

}  // namespace
}  // namespace buckens::base
