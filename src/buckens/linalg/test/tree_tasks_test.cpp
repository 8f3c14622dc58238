// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/tree_tasks.h"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

// Two trees: 5 above 0 and 4, 4 above 1 and 2; 6 above 3.
const std::vector<int> kParent = {5, 4, 4, 6, 5, -1, -1};

TEST(TreeTasks, RunsEachTaskOnceAfterThoseBelowIt) {
  for (const int threads : {1, 2, 3, 8}) {
    TaskPool pool(threads);
    for (int round = 0; round < 50; ++round) {
      std::vector<std::atomic<int>> done(kParent.size());
      run_tree(&pool, kParent, [&](int task) {
        for (std::size_t k = 0; k < kParent.size(); ++k) {
          if (kParent[k] == task) EXPECT_EQ(done[k], 1) << k << " " << task;
        }
        ++done[static_cast<std::size_t>(task)];
      });
      for (const auto& times : done) ASSERT_EQ(times, 1) << threads;
    }
  }
}

TEST(TreeTasks, BeginsWithTheHighestNumberThatMay) {
  std::vector<int> order;
  run_tree(nullptr, kParent, [&](int task) { order.push_back(task); });
  EXPECT_EQ(order, (std::vector<int>{3, 6, 2, 1, 4, 0, 5}));
  run_tree(nullptr, {}, [&](int) { FAIL(); });
}

TEST(TreeTasks, UsesSeveralThreads) {
  TaskPool pool(2);
  std::atomic<int> arrived{0};
  // Each waits for the other: this ends only if both run concurrently.
  run_tree(&pool, {2, 2, -1}, [&](int task) {
    if (task == 2) return;
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(TreeTasks, RunsInsideATask) {
  TaskPool pool(2);
  std::atomic<int> count{0};
  pool.run(2, [&](int) { run_tree(&pool, kParent, [&](int) { ++count; }); });
  EXPECT_EQ(count, 14);
}

TEST(TreeTasks, PassesAnErrorOnAndLeavesOutWhatIsAbove) {
  for (const int threads : {1, 2, 8}) {
    TaskPool pool(threads);
    for (int round = 0; round < 20; ++round) {
      std::atomic<bool> root_ran{false};
      const auto task = [&](int k) {
        if (k == 4) throw std::runtime_error("four");
        if (k == 5) root_ran = true;
      };
      EXPECT_THROW(run_tree(&pool, kParent, task), std::runtime_error);
      EXPECT_FALSE(root_ran);
    }
  }
}

}  // namespace
}  // namespace buckens::linalg
