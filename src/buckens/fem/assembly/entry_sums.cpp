// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/entry_sums.h"

#include <algorithm>
#include <numeric>

namespace buckens::fem {

using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

using ElementBlocks = std::vector<std::shared_ptr<const ElementBlock>>;

/// The elements at each node.
class ElementsAtNodes {
 public:
  ElementsAtNodes(const ElementBlocks& blocks, std::size_t num_nodes) : first_(num_nodes + 1, 0) {
    for (const auto& block : blocks) {
      for (int e = 0; e < block->num_elements(); ++e) nodes_.push_back(block->nodes(e));
    }
    for (const auto& nodes : nodes_) {
      for (const int node : nodes) ++first_[static_cast<std::size_t>(node) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    at_node_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < nodes_.size(); ++e) {
      for (const int node : nodes_[e]) at_node_[next[static_cast<std::size_t>(node)]++] = e;
    }
  }

  int num_nodes() const { return static_cast<int>(first_.size()) - 1; }
  /// Calls visit(nodes) for the elements at a node.
  template <class Visitor>
  void visit(int node, Visitor&& visit) const {
    const auto k = static_cast<std::size_t>(node);
    for (std::size_t place = first_[k]; place < first_[k + 1]; ++place) {
      visit(nodes_[at_node_[place]]);
    }
  }

 private:
  std::vector<std::span<const int>> nodes_;  // of each element
  std::vector<std::size_t> first_, at_node_;
};

/// The nodes that share an element with a node, itself included.
class NodeNeighbours {
 public:
  explicit NodeNeighbours(const ElementsAtNodes& elements)
      : elements_(elements), seen_from_(static_cast<std::size_t>(elements.num_nodes()), -1) {}

  /// Ascending, until the next call.
  const std::vector<int>& of(int node) {
    found_.clear();
    elements_.visit(node, [&](std::span<const int> others) {
      for (const int other : others) {
        int& from = seen_from_[static_cast<std::size_t>(other)];
        if (from == node) continue;
        from = node;
        found_.push_back(other);
      }
    });
    for (const int other : found_) seen_from_[static_cast<std::size_t>(other)] = -1;
    std::sort(found_.begin(), found_.end());
    return found_;
  }

 private:
  const ElementsAtNodes& elements_;
  std::vector<int> seen_from_, found_;
};

template <class Visitor>
void visit_variables(const DofMap& dofs, int node, Visitor&& visit) {
  for (const int dof : dofs.node_dofs[static_cast<std::size_t>(node)]) {
    if (dof >= 0) visit(dof);
  }
}

/// Calls visit(node, its neighbours), each thread for a range of nodes.
template <class Visitor>
void visit_neighbours(const ElementsAtNodes& elements, TaskPool* pool, Visitor&& visit) {
  run_ranges(pool, elements.num_nodes(), [&](int begin, int end) {
    NodeNeighbours neighbours(elements);
    for (int node = begin; node < end; ++node) visit(node, neighbours.of(node));
  });
}

}  // namespace

EntrySums::EntrySums(const ElementBlocks& blocks, const DofMap& dofs, TaskPool* pool)
    : sums_(dofs.num_dofs, dofs.num_dofs) {
  const ElementsAtNodes elements(blocks, dofs.node_dofs.size());
  int* starts = sums_.outerIndexPtr();
  starts[0] = 0;
  visit_neighbours(elements, pool, [&](int node, const std::vector<int>& others) {
    int rows = 0;
    for (const int other : others) visit_variables(dofs, other, [&](int) { ++rows; });
    visit_variables(dofs, node, [&](int dof) { starts[dof + 1] = rows; });
  });
  std::partial_sum(starts, starts + dofs.num_dofs + 1, starts);
  sums_.resizeNonZeros(starts[dofs.num_dofs]);
  has_entry_.resize(static_cast<std::size_t>(sums_.nonZeros()), 0);
  visit_neighbours(elements, pool, [&](int node, const std::vector<int>& others) {
    visit_variables(dofs, node, [&](int dof) {
      std::fill(sums_.valuePtr() + starts[dof], sums_.valuePtr() + starts[dof + 1], 0.0);
      int* row = sums_.innerIndexPtr() + starts[dof];
      for (const int other : others) visit_variables(dofs, other, [&row](int k) { *row++ = k; });
    });
  });
}

template <class IsOwn>
void EntrySums::add_columns(std::span<const Triplet> entries, IsOwn&& is_own) {
  const int* rows = sums_.innerIndexPtr();
  const int* starts = sums_.outerIndexPtr();
  int column = -1;
  bool adds = false;
  int place = 0, end = 0;  // in the column, after the entry before
  for (const Triplet& entry : entries) {
    if (entry.col() != column) {
      column = entry.col();
      adds = is_own(column);
      place = end = starts[column + 1];
    }
    if (!adds) continue;
    // Those of a node follow each other.
    if (place == end || rows[place] != entry.row()) {
      place =
          static_cast<int>(std::lower_bound(rows + starts[column], rows + end, entry.row()) - rows);
    }
    sums_.valuePtr()[place] += entry.value();
    has_entry_[static_cast<std::size_t>(place++)] = 1;
  }
}

void EntrySums::add(const std::vector<std::span<const Triplet>>& lists, TaskPool* pool) {
  // Pieces of a mesh have columns side by side: threads take them in turns, some cache lines each.
  constexpr int kColumnsInTurn = 16;
  const int tasks = pool != nullptr ? pool->threads() : 1;
  run_tasks(pool, tasks, [&](int task) {
    for (const std::span<const Triplet> entries : lists) {
      add_columns(entries, [&](int column) { return column / kColumnsInTurn % tasks == task; });
    }
  });
}

SparseMatrix EntrySums::take() {
  int* starts = sums_.outerIndexPtr();
  int kept = 0;
  int place = 0;
  for (Eigen::Index column = 0; column < sums_.cols(); ++column) {
    for (const int end = starts[column + 1]; place < end; ++place) {
      if (has_entry_[static_cast<std::size_t>(place)] == 0) continue;
      sums_.innerIndexPtr()[kept] = sums_.innerIndexPtr()[place];
      sums_.valuePtr()[kept++] = sums_.valuePtr()[place];
    }
    starts[column + 1] = kept;
  }
  sums_.resizeNonZeros(kept);
  SparseMatrix out;
  out.swap(sums_);
  has_entry_ = {};
  return out;
}

}  // namespace buckens::fem
