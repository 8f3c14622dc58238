// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/allowed_threads.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace buckens::base {
namespace {

TEST(AllowedThreads, TheInnermostCounts) {
  EXPECT_EQ(AllowedThreads::count(), 1);
  EXPECT_EQ(AllowedThreads::pool(), nullptr);
  const AllowedThreads three(3);
  EXPECT_EQ(AllowedThreads::count(), 3);
  TaskPool* pool = AllowedThreads::pool();
  ASSERT_NE(pool, nullptr);
  EXPECT_EQ(pool->threads(), 3);
  {
    const AllowedThreads one(1);
    EXPECT_EQ(AllowedThreads::pool(), nullptr);
  }
  EXPECT_EQ(AllowedThreads::pool(), pool);  // made once
}

TEST(AllowedThreads, MayBeThoseOfAPool) {
  TaskPool pool(2);
  {
    const AllowedThreads those(&pool);
    EXPECT_EQ(AllowedThreads::count(), 2);
    EXPECT_EQ(AllowedThreads::pool(), &pool);
    const AllowedThreads none(nullptr);
    EXPECT_EQ(AllowedThreads::count(), 1);
  }
  EXPECT_EQ(AllowedThreads::count(), 1);
}

TEST(AllowedThreads, AreThoseOfTheCallingThreadOnly) {
  const AllowedThreads two(2);
  int of_other = 0;
  std::thread([&] { of_other = AllowedThreads::count(); }).join();
  EXPECT_EQ(of_other, 1);
}

TEST(RunRanges, CoverEverythingOnce) {
  TaskPool pool(3);
  for (TaskPool* shared : {static_cast<TaskPool*>(nullptr), &pool}) {
    for (const int count : {0, 1, 2, 3, 100}) {
      std::atomic<int> sum{0}, ranges{0};
      run_ranges(shared, count, [&](int begin, int end) {
        ++ranges;
        EXPECT_LT(begin, end);
        for (int k = begin; k < end; ++k) sum += k + 1;
      });
      EXPECT_EQ(sum, count * (count + 1) / 2);
      EXPECT_EQ(ranges, std::min(shared != nullptr ? 3 : 1, count));
    }
  }
}

}  // namespace
}  // namespace buckens::base
