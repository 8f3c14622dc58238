// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/subtree_groups.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

TEST(SubtreeGroups, ShareATreeBelowItsRoot) {
  // Two branches of equal weight under a light root.
  const SubtreeGroups groups = group_subtrees({1, 4, 3, 4, -1}, {4, 4, 4, 4, 1}, 10.0);
  ASSERT_EQ(groups.parent, (std::vector{2, 2, -1}));
  EXPECT_EQ(groups.num_leaves(), 2);
  EXPECT_EQ(groups.group[0], groups.group[1]);
  EXPECT_EQ(groups.group[2], groups.group[3]);
  EXPECT_NE(groups.group[0], groups.group[2]);
  EXPECT_EQ(groups.group[4], 2);
}

TEST(SubtreeGroups, DivideTheHeavierBranch) {
  // The root's branches weigh 1 and 9; the heavier one divides into 4 and 4.
  const SubtreeGroups groups = group_subtrees({4, 3, 3, 4, -1}, {1, 4, 4, 1, 0.5}, 6.0);
  ASSERT_EQ(groups.parent, (std::vector{2, 2, -1}));
  EXPECT_NE(groups.group[1], groups.group[2]);
  EXPECT_EQ(groups.group[3], 2);
  EXPECT_NE(groups.group[0], 2);
}

TEST(SubtreeGroups, LeaveAloneWhatCannotBeShared) {
  EXPECT_EQ(group_subtrees({1, 2, -1}, {5, 5, 5}, 1.0).count(), 1);    // a chain
  EXPECT_EQ(group_subtrees({2, 2, -1}, {1, 1, 9}, 1.0).count(), 1);    // almost all on top
  EXPECT_EQ(group_subtrees({2, 2, -1}, {9, 9, 1}, 100.0).count(), 1);  // too light
  const SubtreeGroups none = group_subtrees({}, {}, 0.0);
  EXPECT_EQ(none.count(), 1);
  EXPECT_TRUE(none.group.empty());
}

TEST(SubtreeGroups, ShareAForestWithNothingAboveIt) {
  const SubtreeGroups groups = group_subtrees({-1, -1, -1, -1}, {3, 3, 3, 3}, 7.0);
  ASSERT_EQ(groups.count(), 3);
  EXPECT_EQ(std::count(groups.group.begin(), groups.group.end(), 0), 2);
  EXPECT_EQ(std::count(groups.group.begin(), groups.group.end(), 1), 2);
}

/// A complete binary tree, children before their parents, all nodes of weight 1.
std::vector<int> complete_tree(int depth) {
  std::vector<int> parent;
  const auto add = [&parent](auto&& self, int levels) -> int {
    std::array<int, 2> below = {-1, -1};
    if (levels > 0) below = {self(self, levels - 1), self(self, levels - 1)};
    const int node = static_cast<int>(parent.size());
    parent.push_back(-1);
    for (const int child : below) {
      if (child >= 0) parent[static_cast<std::size_t>(child)] = node;
    }
    return node;
  };
  add(add, depth);
  return parent;
}

TEST(SubtreeGroups, DivideHalvesAgainDownToThirtyTwo) {
  const std::vector<int> parent = complete_tree(9);  // 1023 nodes
  const std::vector<double> weight(parent.size(), 1.0);
  const SubtreeGroups groups = group_subtrees(parent, weight, 2.0);
  EXPECT_EQ(groups.num_leaves(), 32);
  std::vector<double> of_group(groups.parent.size());
  for (const int g : groups.group) of_group[static_cast<std::size_t>(g)] += 1.0;
  // Nodes follow their parents upwards: a group never stands above that of its node's parent.
  for (std::size_t k = 0; k + 1 < parent.size(); ++k) {
    const int own = groups.group[k], above = groups.group[static_cast<std::size_t>(parent[k])];
    EXPECT_TRUE(own == above || groups.parent[static_cast<std::size_t>(own)] == above) << k;
  }
  EXPECT_EQ(busiest_share(groups.parent, of_group, 1), 1.0);
  // A thread of 2^d carries a subtree of (1023 − (2^d − 1)) / 2^d nodes, and its part of each of
  // the d nodes above.
  for (const int d : {1, 2, 3, 4, 5}) {
    const int threads = 1 << d;
    double expected = (1024.0 - threads) / threads;
    for (int k = 0; k < d; ++k) expected += static_cast<double>(1 << k) / threads;
    EXPECT_NEAR(1023.0 * busiest_share(groups.parent, of_group, threads), expected, 1e-9)
        << threads;
  }
}

TEST(SubtreeGroups, ThreeThreadsGoOnAsTwoAndOne) {
  // Leaves 0, 1 below 2; leaf 3; top 4.
  EXPECT_DOUBLE_EQ(busiest_share({2, 2, 4, 4, -1}, {2, 2, 1, 5, 3}, 3), (3.0 / 3 + 5) / 13);
  EXPECT_DOUBLE_EQ(busiest_share({2, 2, 4, 4, -1}, {4, 4, 2, 3, 3}, 3), (3.0 / 3 + 4 + 1) / 16);
}

}  // namespace
}  // namespace buckens::linalg
