// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "buckens/linalg/supernode_tree.h"

namespace buckens::linalg {

/// How threads divide the fronts of a factor among themselves, and which of them are top fronts
/// (top_fronts.h). The latter depend on the tree alone, since sums depend on them.
class FrontPlan {
 public:
  FrontPlan(const SupernodeTree& tree, int threads);

  /// What one thread does: a whole subtree, or a single front above some.
  struct Part {
    int begin, root;
    double work;
    bool is_single;
  };
  /// For one thread in the order of their roots. For several, those with higher numbers come first
  /// where they may: fronts above others, which free memory, then heavy subtrees, so that light
  /// ones even out the work in the end.
  const std::vector<Part>& parts() const { return parts_; }
  /// Part above each, −1 if there is none.
  const std::vector<int>& above() const { return above_; }
  /// Supernodes above all parts, ascending: all threads work at one after the other.
  const std::vector<int>& shared() const { return shared_; }
  /// The order of one thread: calls part(its number) and shared(supernode).
  template <class DoPart, class DoShared>
  void in_postorder(DoPart&& part, DoShared&& shared) const {
    int next = 0;
    const int count = static_cast<int>(parts_.size());
    for (const int s : shared_) {
      for (; next < count && parts_[static_cast<std::size_t>(next)].root < s; ++next) part(next);
      shared(s);
    }
    for (; next < count; ++next) part(next);
  }
  bool is_top(int s) const { return is_top_[static_cast<std::size_t>(s)]; }
  /// Children whose rests wait for a supernode that is in no whole subtree; none are top fronts.
  const std::vector<int>& waiting(int s) const { return waiting_[static_cast<std::size_t>(s)]; }

 private:
  void find_top(const SupernodeTree& tree);
  void divide(const SupernodeTree& tree, int threads);
  void connect_parts(const SupernodeTree& tree, int threads);

  std::vector<double> below_;  // work of the subtree of each supernode
  double total_ = 0.0;
  std::vector<bool> is_top_;
  std::vector<Part> parts_;
  std::vector<int> above_;
  std::vector<int> shared_;
  std::vector<std::vector<int>> waiting_;
};

/// About the products of a front.
double front_work(const SupernodeTree& tree, int s);
/// Numbers that the fronts of a subtree, supernodes begin … root, take at most at the same time.
std::ptrdiff_t subtree_room(const SupernodeTree& tree, int begin, int root);
/// Children of each of these supernodes.
std::vector<int> count_children(const SupernodeTree& tree, int begin, int root);

}  // namespace buckens::linalg
