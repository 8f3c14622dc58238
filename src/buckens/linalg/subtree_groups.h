// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens::linalg {

/// The nodes of an elimination tree in groups, which form a binary tree themselves: two groups that
/// can be solved concurrently, each with whatever lies below it, and what stands above both.
///
/// Which threads solve them is decided later, so that neither the groups nor any bit of a solve
/// depend on the number of threads.
struct SubtreeGroups {
  std::vector<int> group;   ///< per node of the elimination tree
  std::vector<int> parent;  ///< per group, −1 for the last; children come before their parents

  int count() const { return static_cast<int>(parent.size()); }
  /// Groups without others below them.
  int num_leaves() const { return (count() + 1) / 2; }
};

/// Divides a tree, and its parts again, into halves of about equal weight with as little above them
/// as possible; one group for trees that are too light to divide or cannot be divided. Depends on
/// the tree alone.
/// @param parent per node, −1 for roots; children come before their parents
/// @param weight per node: time of its solve, in any unit
/// @param least total weight from which dividing a part pays
SubtreeGroups group_subtrees(const std::vector<int>& parent, const std::vector<double>& weight,
                             double least);

/// Time of the busiest of several threads over that of one alone, if they need no time to meet and
/// read as fast as one alone: 1/threads at best. Those of a group share it, and go on with the
/// groups below it in halves.
/// @param weight per group
double busiest_share(const std::vector<int>& parent, const std::vector<double>& weight,
                     int threads);

}  // namespace buckens::linalg
