// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/supernode_tree.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace buckens::linalg {

namespace {

/// Up to `columns` columns a supernode may consist of zeros to this share.
struct Allowance {
  double columns;
  double zeros;
};
// Zeros cost memory and flops, narrow supernodes cost calls: CHOLMOD's default limits.
constexpr Allowance kAllowances[] = {{4, 1.0}, {16, 0.8}, {48, 0.1}, {1e300, 0.05}};

/// The elimination tree of a graph whose vertices have been renumbered, with what is found from it.
class Elimination {
 public:
  explicit Elimination(const ColumnGraph& graph)
      : graph_(graph), vertex_(elimination_order(graph)) {
    number();
    find_parents();
    count_rows();
    sort_postorder();
  }

  SupernodeTree tree() {
    join_fundamental();
    join_relaxed();
    SupernodeTree out;
    list_columns(out);
    list_rows(out);
    return out;
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  int size() const { return graph_.size(); }
  int weight(int k) const { return graph_.weight(vertex_[at(k)]); }

  void number() {
    place_.resize(vertex_.size());
    for (int k = 0; k < size(); ++k) place_[at(vertex_[at(k)])] = k;
  }

  template <class Visit>
  void for_each_neighbour(int k, Visit&& visit) const {
    const std::size_t v = at(vertex_[at(k)]);
    for (int e = graph_.begin[v]; e < graph_.begin[v + 1]; ++e) {
      visit(place_[at(graph_.neighbours[at(e)])]);
    }
  }

  void find_parents() {
    parent_.assign(at(size()), -1);
    std::vector<int> ancestor(at(size()), -1);  // with short cuts
    for (int k = 0; k < size(); ++k) {
      for_each_neighbour(k, [&](int i) {
        while (i >= 0 && i < k) {
          const int next = std::exchange(ancestor[at(i)], k);
          if (next < 0) parent_[at(i)] = k;
          i = next;
        }
      });
    }
  }

  /// Rows of L below each vertex: row k consists of the paths from its entries up to k.
  void count_rows() {
    below_.assign(at(size()), 0);
    std::vector<int> seen(at(size()), -1);
    for (int k = 0; k < size(); ++k) {
      seen[at(k)] = k;
      const int columns = weight(k);
      for_each_neighbour(k, [&](int i) {
        if (i > k) return;
        for (; seen[at(i)] != k; i = parent_[at(i)]) {
          seen[at(i)] = k;
          below_[at(i)] += columns;
        }
      });
    }
  }

  /// Subtrees become runs; the child with most rows comes last, since it is the likeliest to be
  /// joined with its parent.
  void sort_postorder() {
    std::vector<std::vector<int>> children(at(size()) + 1);
    for (int k = 0; k < size(); ++k) {
      children[parent_[at(k)] < 0 ? at(size()) : at(parent_[at(k)])].push_back(k);
    }
    for (std::vector<int>& list : children) {
      std::stable_sort(list.begin(), list.end(),
                       [this](int a, int b) { return below_[at(a)] < below_[at(b)]; });
    }
    std::vector<int> order;  // parents first, last children first; then reversed
    std::vector<int> open = children.back();
    while (!open.empty()) {
      const int k = open.back();
      open.pop_back();
      order.push_back(k);
      open.insert(open.end(), children[at(k)].begin(), children[at(k)].end());
    }
    std::reverse(order.begin(), order.end());
    renumber(order);
  }

  void renumber(const std::vector<int>& order) {
    std::vector<int> new_place(order.size());
    for (int k = 0; k < size(); ++k) new_place[at(order[at(k)])] = k;
    std::vector<int> vertex(order.size()), parent(order.size());
    std::vector<std::int64_t> below(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t old = at(order[k]);
      vertex[k] = vertex_[old];
      below[k] = below_[old];
      parent[k] = parent_[old] < 0 ? -1 : new_place[at(parent_[old])];
    }
    vertex_ = std::move(vertex);
    parent_ = std::move(parent);
    below_ = std::move(below);
    number();
  }

  void join_fundamental() {
    std::vector<int> children(at(size()), 0);
    for (const int p : parent_) {
      if (p >= 0) ++children[at(p)];
    }
    begin_.clear();
    for (int k = 0; k < size(); ++k) {
      const bool continues = k > 0 && parent_[at(k - 1)] == k && children[at(k)] == 1 &&
                             below_[at(k - 1)] == below_[at(k)] + weight(k);
      if (!continues) begin_.push_back(k);
    }
    begin_.push_back(size());
  }

  /// Joins a supernode with the one after it, its parent, where few zeros come in; from the top
  /// down, so that what has been joined counts as one.
  void join_relaxed() {
    const int count = static_cast<int>(begin_.size()) - 1;
    std::vector<double> columns(at(count)), below(at(count)), zeros(at(count), 0.0);
    for (int s = 0; s < count; ++s) {
      for (int k = begin_[at(s)]; k < begin_[at(s + 1)]; ++k) columns[at(s)] += weight(k);
      below[at(s)] = static_cast<double>(below_[at(begin_[at(s + 1)] - 1)]);
    }
    std::vector<bool> is_joined(at(count), false);  // with the one before it
    for (int s = count - 2; s >= 0; --s) {
      const int end = begin_[at(s + 1)];
      if (parent_[at(end - 1)] < 0) continue;
      const auto p = at(s + 1);
      if (!is_inside(parent_[at(end - 1)], s + 1, is_joined)) continue;
      const double more = columns[at(s)] * (columns[p] + below[p] - below[at(s)]);
      const double total = columns[at(s)] + columns[p];
      const double stored = 0.5 * total * (total + 1.0) + total * below[p];
      const double share = (zeros[p] + more) / stored;
      const bool is_good = more == 0.0 || std::ranges::any_of(kAllowances, [&](const Allowance& a) {
                             return total <= a.columns && share < a.zeros;
                           });
      if (!is_good) continue;
      is_joined[p] = true;
      columns[at(s)] = total;
      zeros[at(s)] = zeros[p] + more;
      below[at(s)] = below[p];
    }
    std::vector<int> begin;
    for (int s = 0; s < count; ++s) {
      if (!is_joined[at(s)]) begin.push_back(begin_[at(s)]);
    }
    begin.push_back(size());
    begin_ = std::move(begin);
  }

  /// Whether vertex k belongs to supernode s or to those joined to it so far.
  bool is_inside(int k, int s, const std::vector<bool>& is_joined) const {
    std::size_t end = at(s + 1);
    while (end < is_joined.size() && is_joined[end]) ++end;
    return k >= begin_[at(s)] && k < begin_[end];
  }

  void list_columns(SupernodeTree& out) {
    out.size = static_cast<int>(graph_.columns.size());
    out.count = static_cast<int>(begin_.size()) - 1;
    for (int k = 0; k < size(); ++k) {
      first_.push_back(static_cast<int>(out.permutation.size()));
      const auto v = at(vertex_[at(k)]);
      for (int c = graph_.first_column[v]; c < graph_.first_column[v + 1]; ++c) {
        out.permutation.push_back(graph_.columns[at(c)]);
        const double length = static_cast<double>(below_[at(k)] + graph_.first_column[v + 1] - c);
        out.num_entries += length;
        out.num_products += length * length;
      }
    }
    first_.push_back(out.size);
    for (const int k : begin_) out.first_column.push_back(first_[at(k)]);
  }

  void list_rows(SupernodeTree& out) {
    std::vector<int> supernode(at(size()));
    for (int s = 0; s < out.count; ++s) {
      std::fill(supernode.begin() + begin_[at(s)], supernode.begin() + begin_[at(s + 1)], s);
    }
    out.parent.assign(at(out.count), -1);
    out.rows_begin.push_back(0);
    std::vector<std::vector<int>> rows(at(out.count));  // vertices, until the parent has them
    std::vector<std::vector<int>> children(at(out.count));
    std::vector<int> seen(at(size()), -1);
    for (int s = 0; s < out.count; ++s) {
      const int end = begin_[at(s + 1)];
      std::vector<int>& mine = rows[at(s)];
      const auto add = [&](int k) {
        if (k < end || seen[at(k)] == s) return;
        seen[at(k)] = s;
        mine.push_back(k);
      };
      for (int k = begin_[at(s)]; k < end; ++k) for_each_neighbour(k, add);
      for (const int child : children[at(s)]) {
        std::ranges::for_each(rows[at(child)], add);
        std::vector<int>().swap(rows[at(child)]);
      }
      std::sort(mine.begin(), mine.end());
      for (const int k : mine) {
        for (int c = first_[at(k)]; c < first_[at(k + 1)]; ++c) out.rows.push_back(c);
      }
      out.rows_begin.push_back(static_cast<std::int64_t>(out.rows.size()));
      if (mine.empty()) continue;
      out.parent[at(s)] = supernode[at(mine.front())];
      children[at(out.parent[at(s)])].push_back(s);
    }
  }

  const ColumnGraph& graph_;
  std::vector<int> vertex_, place_;  // vertex at each place, and the reverse
  std::vector<int> parent_;          // by places, like all below
  std::vector<std::int64_t> below_;
  std::vector<int> begin_;  // first place of each supernode, and the end
  std::vector<int> first_;  // column of each place, and the end
};

}  // namespace

SupernodeTree find_supernode_tree(const SparseMatrix& A) {
  return find_supernode_tree(column_graph(A));
}

SupernodeTree find_supernode_tree(const MatrixSum& A) {
  return find_supernode_tree(column_graph(A));
}

SupernodeTree find_supernode_tree(const ColumnGraph& graph) { return Elimination(graph).tree(); }

SupernodeTree supernode_tree(const Supernodes& source) {
  const auto count = static_cast<std::size_t>(source.count);
  SupernodeTree tree;
  tree.size = source.size;
  tree.count = source.count;
  tree.permutation.assign(source.permutation, source.permutation + source.size);
  tree.first_column.assign(source.first_column, source.first_column + count + 1);
  tree.rows_begin.push_back(0);
  std::vector<int> supernode_of(static_cast<std::size_t>(source.size));
  for (int s = 0; s < source.count; ++s) {
    std::fill(supernode_of.begin() + source.first_column[s],
              supernode_of.begin() + source.first_column[s + 1], s);
    const int* rows = source.rows + source.rows_begin[s];
    tree.rows.insert(tree.rows.end(), rows + source.columns(s), rows + source.num_rows(s));
    tree.rows_begin.push_back(static_cast<std::int64_t>(tree.rows.size()));
  }
  for (int s = 0; s < source.count; ++s) {
    const bool is_root = tree.rows_below(s) == 0;
    const auto first = static_cast<std::size_t>(is_root ? 0 : tree.rows_of(s)[0]);
    tree.parent.push_back(is_root ? -1 : supernode_of[first]);
  }
  return tree;
}

}  // namespace buckens::linalg
