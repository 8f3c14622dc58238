// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/predicted_factor.h"

#include <algorithm>
#include <vector>

#include "buckens/linalg/divided_graph.h"
#include "buckens/linalg/front.h"
#include "buckens/linalg/front_plan.h"
#include "buckens/linalg/panel_kernels.h"
#include "buckens/linalg/supernode_tree.h"
#include "buckens/linalg/top_fronts.h"

namespace buckens::linalg {

namespace {

/// Of a supernode in panels: blocks of rows, of which those in the triangle end at the diagonal.
double bytes_in_panels(int columns, int below) {
  double entries = 0;
  for (int row = 0; row < columns; row += kPanelRows) {
    entries += static_cast<double>(kPanelRows) * std::min(columns, row + kPanelRows);
  }
  const int blocks = (below + kPanelRows - 1) / kPanelRows;
  entries += static_cast<double>(blocks) * kPanelRows * columns;
  return entries * sizeof(double);
}

/// Goes through the tree as one thread does (multifrontal.cpp), with memory only.
class PostorderMemory {
 public:
  explicit PostorderMemory(const SupernodeTree& tree) : tree_(tree), plan_(tree, 1) {
    plan_.in_postorder([this](int k) { part(plan_.parts()[static_cast<std::size_t>(k)]); },
                       [this](int s) { plan_.is_top(s) ? top(s) : shared(s); });
  }

  double columns() const { return finished_; }
  double most() const { return most_; }

 private:
  Front front(int s) const { return {tree_.columns(s), tree_.rows_below(s)}; }
  double own(int s) const { return kNumber * static_cast<double>(front(s).own_size()); }
  double rest(int s) const { return kNumber * static_cast<double>(front(s).rest_size()); }

  void note(double more) { most_ = std::max(most_, finished_ + open_ + waiting_ + room_ + more); }

  void finish(int begin, int root) {
    for (int s = begin; s <= root; ++s) {
      finished_ += bytes_in_panels(tree_.columns(s), tree_.rows_below(s));
    }
  }

  void part(const FrontPlan::Part& part) {
    const double room =
        part.is_single ? own(part.root)
                       : kNumber * static_cast<double>(subtree_room(tree_, part.begin, part.root));
    room_ = std::max(room_, room);  // that of the part before is used again
    finish(part.begin, part.root);
    note(rest(part.root));
    if (part.is_single) take_rests(part.root);
    waiting_ += rest(part.root);
  }

  void shared(int s) {
    room_ = 0;
    note(own(s) + rest(s));
    take_rests(s);
    finish(s, s);
    note(own(s) + rest(s));
    waiting_ += rest(s);
  }

  void top(int s) {
    room_ = 0;
    if (is_open_.empty()) {
      is_open_.resize(static_cast<std::size_t>(tree_.count));
      open_ += kNumber * Trapezoid::kBlock * Trapezoid::kBlock;  // for products
    }
    for (int t = s; t >= 0 && !is_open_[static_cast<std::size_t>(t)];
         t = tree_.parent[static_cast<std::size_t>(t)]) {
      is_open_[static_cast<std::size_t>(t)] = true;
      open_ += own(t);
    }
    note(0);
    take_rests(s);
    const int columns = std::min(tree_.columns(s), TopFronts::kBlocks * Trapezoid::kBlock);
    note(bytes_in_panels(columns, front(s).own().rows - columns));
    open_ -= own(s);
    finish(s, s);
  }

  void take_rests(int s) {
    for (const int child : plan_.waiting(s)) waiting_ -= rest(child);
  }

  static constexpr double kNumber = sizeof(double);

  const SupernodeTree& tree_;
  FrontPlan plan_;
  std::vector<bool> is_open_;  // top fronts that have memory, or had it
  double finished_ = 0, open_ = 0, waiting_ = 0, room_ = 0, most_ = 0;
};

}  // namespace

PredictedFactor predict_factor(const MatrixSum& A) {
  const SupernodeTree tree =
      A.is_divided() ? find_supernode_tree(column_graph(A.divide())) : find_supernode_tree(A);
  const PostorderMemory memory(tree);
  return {memory.columns(), memory.most()};
}

double most_factor_bytes(Eigen::Index size) {
  return 0.5 * sizeof(double) * static_cast<double>(size) * static_cast<double>(size + 1);
}

}  // namespace buckens::linalg
