// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/box_tree.h"

#include <algorithm>
#include <numeric>

namespace buckens::loads {

using Eigen::AlignedBox3d;

namespace {

constexpr int kMostInLeaf = 4;

}  // namespace

BoxTree::BoxTree(std::span<const AlignedBox3d> boxes, std::span<const std::uint32_t> marks)
    : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  nodes_.reserve(boxes.size());
  add(boxes, marks, 0, static_cast<int>(boxes.size()));
}

int BoxTree::add(std::span<const AlignedBox3d> boxes, std::span<const std::uint32_t> marks,
                 int first, int count) {
  const auto own = static_cast<std::size_t>(nodes_.size());
  nodes_.emplace_back();
  AlignedBox3d box, centres;
  std::uint32_t bits = 0;
  for (int k = first; k < first + count; ++k) {
    const auto item = static_cast<std::size_t>(items_[static_cast<std::size_t>(k)]);
    box.extend(boxes[item]);
    centres.extend(boxes[item].center());
    bits |= marks[item];
  }
  nodes_[own].box = box;
  nodes_[own].marks = bits;
  nodes_[own].first = first;
  nodes_[own].count = count;
  if (count <= kMostInLeaf) return static_cast<int>(own);
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto begin = items_.begin() + first;
  const int half = count / 2;
  // Ties by number: the tree depends on the boxes alone.
  std::nth_element(begin, begin + half, begin + count, [&](int a, int b) {
    const double x = boxes[static_cast<std::size_t>(a)].center()[axis];
    const double y = boxes[static_cast<std::size_t>(b)].center()[axis];
    return x < y || (x == y && a < b);
  });
  add(boxes, marks, first, half);
  const int right = add(boxes, marks, first + half, count - half);
  nodes_[own].right = right;
  return static_cast<int>(own);
}

}  // namespace buckens::loads
