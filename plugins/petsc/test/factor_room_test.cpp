// SPDX-License-Identifier: Apache-2.0
#include "plugins/petsc/factor_room.h"

#include <gtest/gtest.h>

namespace buckens_petsc {
namespace {

constexpr double kMillion = 1e6;

TEST(FactorRoom, AddsWhatLackedSomeTimesOver) {
  FactorRoom room(30 * kMillion, 40 * kMillion);
  EXPECT_EQ(room.numbers(), 30 * kMillion);
  ASSERT_TRUE(room.grow(0.3 * kMillion));
  EXPECT_DOUBLE_EQ(room.numbers(), 30.725 * kMillion);  // twice, and an eighth of a million
  ASSERT_TRUE(room.grow(0.1 * kMillion));
  EXPECT_DOUBLE_EQ(room.numbers(), 31.65 * kMillion);  // eight times
}

TEST(FactorRoom, AddsNoMoreThanThePrediction) {
  FactorRoom room(30 * kMillion, 40 * kMillion);
  ASSERT_TRUE(room.grow(20 * kMillion));
  EXPECT_EQ(room.numbers(), 41 * kMillion);
}

TEST(FactorRoom, GetsMultiplesOfThePredictionAtLast) {
  FactorRoom room(30 * kMillion, 40 * kMillion);
  int tries = 1;
  double before = room.numbers();
  while (room.grow(0.1 * kMillion)) {
    EXPECT_GT(room.numbers(), before);
    before = room.numbers();
    ++tries;
  }
  EXPECT_EQ(tries, 8);
  EXPECT_EQ(before, 417 * kMillion);
}

TEST(FactorRoom, GetsThePredictionIfNothingTellsWhatLacked) {
  FactorRoom room(30 * kMillion, 40 * kMillion);
  ASSERT_TRUE(room.grow(0));
  EXPECT_EQ(room.numbers(), 41 * kMillion);
}

TEST(LightestPlace, IsThatOfTheLeastNumbers) {
  EXPECT_EQ(lightest_place({267, 235, 254, 275}), 1);
  EXPECT_EQ(lightest_place({267, 254, 275, 235}), 3);
}

TEST(LightestPlace, IsTheFirstIfLittleIsWon) {
  EXPECT_EQ(lightest_place({267, 255, 280}), 0);
  EXPECT_EQ(lightest_place({235, 267}), 0);
  EXPECT_EQ(lightest_place({1}), 0);
}

}  // namespace
}  // namespace buckens_petsc
