// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens::linalg {

/// Whole subtrees of an elimination tree gathered into groups that can be solved concurrently, and
/// the nodes above them.
struct SubtreeGroups {
  static constexpr int kTop = -1;
  std::vector<int> group;  ///< per node: 0, 1 … or kTop
  int count = 1;
};

/// Two groups of about equal weight with as little above them as possible; one group, without a
/// top, for trees that are too light to split or cannot be split. Depends on the tree alone.
/// @param parent per node, −1 for roots; children come before their parents
/// @param weight per node: time of its solve, in any unit
/// @param least total weight from which splitting pays
SubtreeGroups group_subtrees(const std::vector<int>& parent, const std::vector<double>& weight,
                             double least);

}  // namespace buckens::linalg
