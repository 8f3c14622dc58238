// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/shift_search.h"

#include <gtest/gtest.h>

namespace buckens::body {
namespace {

TEST(ShiftSearch, BeginsAboveTheRoundingOfStiffness) {
  EXPECT_EQ(ShiftSearch(5.0, 1e10).shift(), 5.0);
  EXPECT_DOUBLE_EQ(ShiftSearch(1e-9, 1e10).shift(), 1e-3);
}

TEST(ShiftSearch, GoesDownTowardsTheLowestSquare) {
  ShiftSearch search(1e6, 1e10);
  EXPECT_FALSE(search.is_too_high(1e5)) << "it may be ten times as high";
  EXPECT_TRUE(search.is_too_high(1e4));
  search.lower(1e4);
  EXPECT_DOUBLE_EQ(search.shift(), 3e3);
  EXPECT_EQ(search.attempt(), 2);
  search.lower(1e-3);
  EXPECT_DOUBLE_EQ(search.shift(), 3.0) << "a thousandth at most at once";
}

TEST(ShiftSearch, StaysAboveWhatWasLost) {
  ShiftSearch search(1.0, 1e10);
  EXPECT_TRUE(search.raise());
  EXPECT_DOUBLE_EQ(search.shift(), 30.0);
  EXPECT_TRUE(search.is_too_high(1e-6));
  search.lower(1e-6);
  EXPECT_DOUBLE_EQ(search.shift(), 10.0);
  EXPECT_FALSE(search.is_too_high(1e-6)) << "no lower one is useful";
}

TEST(ShiftSearch, EndsAfterTwelveFactors) {
  ShiftSearch search(1.0, 1.0);
  while (search.raise()) {
  }
  EXPECT_EQ(search.attempt(), 12);
  EXPECT_FALSE(search.is_too_high(1e-30)) << "the last one is kept";
}

}  // namespace
}  // namespace buckens::body
