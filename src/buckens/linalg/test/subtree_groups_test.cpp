// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/subtree_groups.h"

#include <array>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

constexpr int kTop = SubtreeGroups::kTop;

TEST(SubtreeGroups, ShareATreeBelowItsRoot) {
  // Two branches of equal weight under a light root.
  const SubtreeGroups groups = group_subtrees({1, 4, 3, 4, -1}, {4, 4, 4, 4, 1}, 1.0);
  EXPECT_EQ(groups.count, 2);
  EXPECT_EQ(groups.group[0], groups.group[1]);
  EXPECT_EQ(groups.group[2], groups.group[3]);
  EXPECT_NE(groups.group[0], groups.group[2]);
  EXPECT_EQ(groups.group[4], kTop);
}

TEST(SubtreeGroups, DivideTheHeavierBranch) {
  // The root's branches weigh 1 and 9; the heavier one divides into 4 and 4.
  const SubtreeGroups groups = group_subtrees({4, 3, 3, 4, -1}, {1, 4, 4, 1, 0.5}, 1.0);
  EXPECT_EQ(groups.count, 2);
  EXPECT_NE(groups.group[1], groups.group[2]);
  EXPECT_EQ(groups.group[3], kTop);
  EXPECT_NE(groups.group[0], kTop);
}

TEST(SubtreeGroups, LeaveAloneWhatCannotBeShared) {
  EXPECT_EQ(group_subtrees({1, 2, -1}, {5, 5, 5}, 1.0).count, 1);    // a chain
  EXPECT_EQ(group_subtrees({2, 2, -1}, {1, 1, 9}, 1.0).count, 1);    // almost all on top
  EXPECT_EQ(group_subtrees({2, 2, -1}, {9, 9, 1}, 100.0).count, 1);  // too light
  const SubtreeGroups none = group_subtrees({}, {}, 0.0);
  EXPECT_EQ(none.count, 1);
  EXPECT_TRUE(none.group.empty());
}

TEST(SubtreeGroups, ShareAForestWithoutATop) {
  const SubtreeGroups groups = group_subtrees({-1, -1, -1, -1}, {3, 3, 3, 3}, 1.0);
  EXPECT_EQ(groups.count, 2);
  std::array<int, 2> members{};
  for (const int g : groups.group) {
    ASSERT_NE(g, kTop);
    ++members[static_cast<std::size_t>(g)];
  }
  EXPECT_EQ(members[0], 2);
  EXPECT_EQ(members[1], 2);
}

}  // namespace
}  // namespace buckens::linalg
