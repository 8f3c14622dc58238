// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/task_pool.h"

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace buckens {
namespace {

TEST(TaskPool, CarriesEachTaskOutOnce) {
  for (const int threads : {1, 2, 4}) {
    TaskPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const int count : {0, 1, 2, 3, 100}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      pool.run(count, [&](int k) { ++done[static_cast<std::size_t>(k)]; });
      for (const auto& times : done) EXPECT_EQ(times, 1) << threads << " " << count;
    }
  }
}

TEST(TaskPool, TwoTasksRunAtTheSameTime) {
  TaskPool pool(2);
  std::atomic<int> arrived{0};
  // Each waits for the other: this ends only if both run concurrently.
  pool.run(2, [&](int) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(TaskPool, TasksWithinTasksRunInTurn) {
  TaskPool pool(2);
  std::atomic<int> sum{0};
  EXPECT_EQ(pool.available(), 2);
  pool.run(3, [&](int k) {
    EXPECT_EQ(pool.available(), 1);
    pool.run(4, [&](int m) { sum += 10 * k + m; });
  });
  EXPECT_EQ(sum, 10 * (0 + 1 + 2) * 4 + 3 * (0 + 1 + 2 + 3));
}

TEST(TaskPool, PassesTheFirstErrorOnAndStaysUsable) {
  TaskPool pool(2);
  const auto fail = [](int k) {
    if (k >= 3) throw std::runtime_error("task " + std::to_string(k));
  };
  for (int round = 0; round < 20; ++round) {
    try {
      pool.run(8, fail);
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "task 3");
    }
  }
  std::atomic<int> done{0};
  pool.run(5, [&](int) { ++done; });
  EXPECT_EQ(done, 5);
}

TEST(TaskPool, ServesSeveralCallersOneAfterTheOther) {
  TaskPool pool(2);
  std::atomic<long> sum{0};
  const auto caller = [&] {
    for (int k = 0; k < 200; ++k) pool.run(3, [&](int m) { sum += m; });
  };
  std::thread other(caller);
  caller();
  other.join();
  EXPECT_EQ(sum, 2 * 200 * 3);
}

TEST(TaskPool, WithoutAPoolTasksRunInOrder) {
  std::vector<int> order;
  run_tasks(nullptr, 3, [&](int k) { order.push_back(k); });
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace buckens
