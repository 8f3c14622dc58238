// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace buckens::loads {

/// Bounding boxes of many items, in a binary tree: halved at the middle item along the longest side
/// of the box around their centres. Made once; the items do not move against each other.
class BoxTree {
 public:
  /// @param boxes one per item, @param marks bits of each item; a node has those of all its items
  BoxTree(std::span<const Eigen::AlignedBox3d> boxes, std::span<const std::uint32_t> marks);

  const Eigen::AlignedBox3d& box() const { return nodes_.front().box; }

  /// Calls visit(item) for all items in nodes that are wanted, those with the smaller measure
  /// first.
  /// @param measure (box) → what nodes are ordered by, such as a distance
  /// @param is_wanted (measure, marks) → whether to look into a node; asked again before it is
  /// entered, since what was found meanwhile may have changed the answer
  template <class Measure, class IsWanted, class Visit>
  void search(Measure&& measure, IsWanted&& is_wanted, Visit&& visit) const {
    struct Waiting {
      int node;
      double measure;
    };
    std::array<Waiting, kMostDepth> stack;
    std::size_t count = 0;
    stack[count++] = {0, measure(nodes_.front().box)};
    while (count > 0) {
      const Waiting next = stack[--count];
      const Node& node = nodes_[static_cast<std::size_t>(next.node)];
      if (!is_wanted(next.measure, node.marks)) continue;
      if (node.right < 0) {
        for (int k = node.first; k < node.first + node.count; ++k) {
          visit(items_[static_cast<std::size_t>(k)]);
        }
        continue;
      }
      const int left = next.node + 1;
      const double near = measure(nodes_[static_cast<std::size_t>(left)].box);
      const double far = measure(nodes_[static_cast<std::size_t>(node.right)].box);
      const bool left_first = near <= far;
      stack[count++] = left_first ? Waiting{node.right, far} : Waiting{left, near};
      stack[count++] = left_first ? Waiting{left, near} : Waiting{node.right, far};
    }
  }

 private:
  // Halving at the middle: 2³¹ items have 31 levels, each of which leaves one node waiting.
  static constexpr std::size_t kMostDepth = 64;
  struct Node {
    Eigen::AlignedBox3d box;
    int right = -1;  // the left child is the next node; −1: a leaf
    int first = 0, count = 0;
    std::uint32_t marks = 0;
  };
  int add(std::span<const Eigen::AlignedBox3d> boxes, std::span<const std::uint32_t> marks,
          int first, int count);

  std::vector<Node> nodes_;
  std::vector<int> items_;
};

}  // namespace buckens::loads
