// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/front_plan.h"

#include <algorithm>

#include "buckens/linalg/front.h"

namespace buckens::linalg {

namespace {

// Subtrees per thread: enough to even out their work, few enough to leave large ones.
constexpr double kSubtreesPerThread = 6.0;
// Fronts of up to so many products have few tiles: threads are busier with one such front each than
// with sharing one.
constexpr double kFewTiles = 1e9;
// But no such front may take longer than this share of what each thread does: the others would wait
// for it.
constexpr double kLongest = 1.0 / 25.0;
// Top fronts have more products than this, and with those below them this share of all: more of
// them would save next to no memory, and threads would share small ones.
constexpr double kLargeTop = 3e9, kTopShare = 1.0 / 400.0;
// In small trees, fronts that take this share of the factor, and are worth sharing.
constexpr double kTopMemory = 1.0 / 20.0, kSmallTop = 1e8;

std::size_t slot_of(int s) { return static_cast<std::size_t>(s); }

}  // namespace

double front_work(const SupernodeTree& tree, int s) {
  const double columns = tree.columns(s);
  const double rows = tree.columns(s) + tree.rows_below(s);
  return columns * rows * rows;
}

std::vector<int> count_children(const SupernodeTree& tree, int begin, int root) {
  std::vector<int> children(slot_of(root - begin + 1));
  for (int s = begin; s < root; ++s) ++children[slot_of(tree.parent[slot_of(s)] - begin)];
  return children;
}

std::ptrdiff_t subtree_room(const SupernodeTree& tree, int begin, int root) {
  std::vector<std::ptrdiff_t> waiting;
  std::ptrdiff_t used = 0, most = 0;
  const std::vector<int> children = count_children(tree, begin, root);
  for (int s = begin; s <= root; ++s) {
    const Front f(tree.columns(s), tree.rows_below(s));
    most = std::max(most, used + f.rest_size() + f.own_size());
    for (int k = children[slot_of(s - begin)]; k > 0; --k) {
      used -= waiting.back();
      waiting.pop_back();
    }
    waiting.push_back(f.rest_size());
    used += f.rest_size();
  }
  return most;
}

FrontPlan::FrontPlan(const SupernodeTree& tree, int threads)
    : below_(slot_of(tree.count)), is_top_(slot_of(tree.count)), waiting_(slot_of(tree.count)) {
  find_top(tree);
  divide(tree, threads);
  connect_parts(tree, threads);
}

void FrontPlan::find_top(const SupernodeTree& tree) {
  double numbers = 0.0;
  for (int s = 0; s < tree.count; ++s) {
    total_ += front_work(tree, s);
    numbers += tree.columns(s) * (tree.rows_below(s) + 0.5 * tree.columns(s));
  }
  for (int s = 0; s < tree.count; ++s) {
    const double work = front_work(tree, s);
    const Front front(tree.columns(s), tree.rows_below(s));
    const auto taken = static_cast<double>(front.own_size() + front.rest_size());
    below_[slot_of(s)] += work;
    if ((work > kLargeTop && below_[slot_of(s)] > kTopShare * total_) ||
        (work > kSmallTop && taken > kTopMemory * numbers)) {
      is_top_[slot_of(s)] = true;
    }
    const int p = tree.parent[slot_of(s)];
    if (p < 0) continue;
    below_[slot_of(p)] += below_[slot_of(s)];
    if (is_top(s)) is_top_[slot_of(p)] = true;
  }
}

void FrontPlan::divide(const SupernodeTree& tree, int threads) {
  const double most = total_ / (kSubtreesPerThread * threads);
  const double heaviest = std::min(kFewTiles, kLongest * total_ / threads);
  const auto is_in_subtree = [&](int s) { return below_[slot_of(s)] <= most && !is_top(s); };
  std::vector<int> begin(slot_of(tree.count));
  for (int s = 0; s < tree.count; ++s) begin[slot_of(s)] = s;
  std::vector<Part> singles;
  std::vector<bool> is_shared = is_top_;
  for (int s = 0; s < tree.count; ++s) {
    const int p = tree.parent[slot_of(s)];
    if (p >= 0) begin[slot_of(p)] = std::min(begin[slot_of(p)], begin[slot_of(s)]);
    if (is_in_subtree(s)) {
      if (p < 0 || !is_in_subtree(p)) {
        parts_.push_back({begin[slot_of(s)], s, below_[slot_of(s)], false});
      }
    } else if (is_shared[slot_of(s)] || front_work(tree, s) > heaviest) {
      shared_.push_back(s);
      if (p >= 0) is_shared[slot_of(p)] = true;
    } else {
      singles.push_back({s, s, front_work(tree, s), true});
    }
    if (p >= 0 && !is_in_subtree(p) && !is_top(s)) waiting_[slot_of(p)].push_back(s);
  }
  std::ranges::stable_sort(parts_, std::ranges::less{}, &Part::work);
  parts_.insert(parts_.end(), singles.begin(), singles.end());
}

void FrontPlan::connect_parts(const SupernodeTree& tree, int threads) {
  if (threads == 1) std::ranges::sort(parts_, std::ranges::less{}, &Part::root);
  std::vector<int> part(slot_of(tree.count), -1);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    part[slot_of(parts_[k].root)] = static_cast<int>(k);
  }
  for (const Part& p : parts_) {
    const int parent = tree.parent[slot_of(p.root)];
    above_.push_back(parent < 0 ? -1 : part[slot_of(parent)]);
  }
}

}  // namespace buckens::linalg
