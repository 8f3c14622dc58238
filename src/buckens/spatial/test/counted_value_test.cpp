// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/counted_value.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace buckens::spatial {
namespace {

TEST(CountedValue, FollowsWhatIsExpected) {
  // 20 rad/s for a second: 3 turns and 1.15 rad.
  const CountedValue now = follow_turns(expected_at({5, 0.1, 20.0, 2.0}, 3.0), 20.1 - 3 * kTurn);
  EXPECT_EQ(now.turns, 8);
  EXPECT_NEAR(now.value(), 5 * kTurn + 20.1, 1e-13);
  EXPECT_EQ(now.t, 3.0);
}

TEST(CountedValue, KeepsItsTurnsWhereTheMotionHasDiverged) {
  for (const double rate : {1e300, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(follow_turns(expected_at({5, 0.1, rate, 2.0}, 3.0), 0.5).turns, 5);
  }
}

TEST(CountedValue, TurnsTheWayThatIsExpected) {
  EXPECT_NEAR(way_turned(3.0, -3.0, 0.0), kTurn - 6.0, 1e-15);
  EXPECT_NEAR(way_turned(3.0, -3.0, -6.0), -6.0, 1e-15);
  EXPECT_NEAR(way_turned(0.0, 0.0, 3.1 * kTurn), 3.0 * kTurn, 1e-14);
}

}  // namespace
}  // namespace buckens::spatial
