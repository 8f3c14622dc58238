// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_factor.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Dense>

#include "buckens/linalg/multifrontal.h"
#include "buckens/linalg/single_thread.h"
#include "buckens/linalg/subtree_groups.h"

// LAPACK, in OpenBLAS.
extern "C" void dtrtri_(const char* part, const char* diagonal, const int* size, double* values,
                        const int* stride, int* failed);

namespace buckens::linalg {

namespace {

// Bytes from which two threads pay: their start costs as much as some 50 kB of reading each.
constexpr double kShared = 4e6;

// Values of CHOLMOD's factor released at a time: enough to make the call negligible.
constexpr std::ptrdiff_t kGivenUp = std::ptrdiff_t{1} << 20;

using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

std::vector<double> supernode_bytes(const SupernodeTree& tree) {
  std::vector<double> bytes;
  for (int s = 0; s < tree.count; ++s) {
    const double columns = tree.columns(s);
    bytes.push_back(8.0 * columns * (tree.rows_below(s) + 0.5 * columns));
  }
  return bytes;
}

/// @param rows present, the others become zero @return past the block
double* copy_block(const double* from, Eigen::Index stride, int rows, int columns, double* to) {
  for (int c = 0; c < columns; ++c, from += stride, to += kPanelRows) {
    std::copy(from, from + rows, to);
    std::fill(to + rows, to + kPanelRows, 0.0);
  }
  return to;
}

}  // namespace

/// Lays a PanelFactor out and fills it, supernode by supernode in any order.
class PanelFactor::Layout {
 public:
  Layout(const SupernodeTree& tree, PanelFactor& factor)
      : tree_(tree),
        factor_(factor),
        groups_(group_subtrees(tree.parent, supernode_bytes(tree), kShared)),
        place_(static_cast<std::size_t>(tree.size)),
        group_of_(static_cast<std::size_t>(tree.size)),
        first_panel_(static_cast<std::size_t>(tree.count)) {
    place_columns();
    count();
    place_rows();
  }

  /// Takes the finished columns begin … end of supernode s (multifrontal.h).
  void fill(int s, int begin, int end, const double* corner, std::ptrdiff_t stride) {
    const int first = first_panel_[static_cast<std::size_t>(s)];
    const Panel& panel = factor_.panels_[static_cast<std::size_t>(first + begin / kPanelColumns)];
    double* values = factor_.values_.data() + (panel.values - factor_.values_.data());
    values = fill_triangle(panel, corner, stride, values);
    const double* below = corner + (end - begin);
    const int count = tree_.columns(s) + tree_.rows_below(s) - end;
    for (int b = 0; b < panel.row_blocks; ++b) {
      const int present = std::min(kPanelRows, count - kPanelRows * b);
      values = copy_block(below + static_cast<std::ptrdiff_t>(kPanelRows) * b, stride, present,
                          panel.columns, values);
    }
  }

 private:
  /// f(supernode, first, end of its columns) in the order of memory.
  template <class F>
  void for_all_panels(F&& f) {
    for (int g = 0; g <= groups_.count; ++g) {
      const int wanted = g < groups_.count ? g : SubtreeGroups::kTop;
      for (int s = 0; s < tree_.count; ++s) {
        if (group_of_supernode(s) != wanted) continue;
        for (int begin = 0; begin < tree_.columns(s); begin += kPanelColumns) {
          f(s, begin, std::min(begin + kPanelColumns, tree_.columns(s)));
        }
      }
    }
  }

  template <class F>
  void for_all_columns(F&& f) {
    for (int s = 0; s < tree_.count; ++s) {
      const auto next = static_cast<std::size_t>(s) + 1;
      for (int c = tree_.first_column[next - 1]; c < tree_.first_column[next]; ++c) {
        f(group_of_supernode(s), c);
      }
    }
  }

  void place_columns() {
    factor_.groups_.resize(static_cast<std::size_t>(groups_.count));
    for_all_columns([this](int g, int c) {
      int& columns = g == SubtreeGroups::kTop ? factor_.top_columns_ : group(g).columns;
      place_[static_cast<std::size_t>(c)] = columns++;
      group_of_[static_cast<std::size_t>(c)] = g;
    });
    for (Group& g : factor_.groups_) {
      g.first = factor_.num_places_;
      factor_.num_places_ += g.columns + factor_.top_columns_ + 1;
    }
    factor_.origin_.assign(static_cast<std::size_t>(factor_.num_places_), -1);
    for_all_columns([this](int g, int c) {
      factor_.origin_[static_cast<std::size_t>(place(c, std::max(0, g)))] =
          tree_.permutation[static_cast<std::size_t>(c)];
    });
  }

  Group& group(int g) { return factor_.groups_[static_cast<std::size_t>(g)]; }
  int group_of_supernode(int s) const { return groups_.group[static_cast<std::size_t>(s)]; }
  /// Where group g finds a column of its own or of the top.
  int place(int column, int g) {
    const auto c = static_cast<std::size_t>(column);
    return group_of_[c] == SubtreeGroups::kTop ? factor_.top_place(g) + place_[c]
                                               : group(g).first + place_[c];
  }
  int missing_place(int g) { return factor_.top_place(g) + factor_.top_columns_; }

  void count() {
    std::ptrdiff_t lines = 0;
    std::size_t rows = 0;
    for_all_panels([&](int s, int begin, int end) {
      const int g = group_of_supernode(s);
      Panel panel{};
      const int first = tree_.first_column[static_cast<std::size_t>(s)];
      panel.first = place(first + begin, std::max(0, g));
      panel.columns = end - begin;
      const int below = tree_.columns(s) + tree_.rows_below(s) - end;
      panel.row_blocks = (below + kPanelRows - 1) / kPanelRows;
      lines += panel.num_lines();
      rows += static_cast<std::size_t>(kPanelRows * panel.row_blocks);
      const int before = static_cast<int>(factor_.panels_.size());
      if (begin == 0) first_panel_[static_cast<std::size_t>(s)] = before;
      factor_.panels_.push_back(panel);
      if (g == SubtreeGroups::kTop) return;
      group(g).panels_end = before + 1;
      if (g + 1 < groups_.count) group(g + 1).panels_begin = group(g + 1).panels_end = before + 1;
      factor_.top_begin_ = before + 1;
    });
    factor_.values_ = StreamingMemory(static_cast<std::size_t>(kPanelRows * lines));
    factor_.rows_.reserve(rows);  // panels keep pointers into it
  }

  void place_rows() {
    std::size_t next = 0;
    const double* values = factor_.values_.data();
    for_all_panels([&](int s, int begin, int end) {
      const int g = std::max(0, group_of_supernode(s));
      Panel& panel = factor_.panels_[next++];
      panel.values = values;
      values += kPanelRows * panel.num_lines();
      panel.rows = factor_.rows_.data() + factor_.rows_.size();
      const int first = tree_.first_column[static_cast<std::size_t>(s)];
      const int own = tree_.columns(s);
      const int present = own + tree_.rows_below(s) - end;
      for (int i = 0; i < kPanelRows * panel.row_blocks; ++i) {
        const int row = end + i;  // of the supernode
        const bool is_own = row < own;
        factor_.rows_.push_back(i >= present ? missing_place(g)
                                : is_own     ? place(first + row, g)
                                             : place(tree_.rows_of(s)[row - own], g));
      }
      static_cast<void>(begin);
    });
  }

  static double* fill_triangle(const Panel& panel, const double* corner, std::ptrdiff_t stride,
                               double* values) {
    const int columns = panel.columns;
    Eigen::MatrixXd inverse(columns, columns);
    inverse.triangularView<Eigen::Lower>() =
        Block(corner, columns, columns, Eigen::OuterStride<>(stride));
    inverse.triangularView<Eigen::StrictlyUpper>().setZero();
    int failed = 0;  // never: the pivots are positive
    const SingleThread alone;
    dtrtri_("L", "N", &columns, inverse.data(), &columns, &failed);
    for (int b = 0; b < panel.triangle_blocks(); ++b) {
      const int rows = std::min(kPanelRows, columns - kPanelRows * b);
      values = copy_block(inverse.data() + static_cast<std::ptrdiff_t>(kPanelRows) * b, columns,
                          rows, panel.triangle_columns(b), values);
    }
    return values;
  }

  const SupernodeTree& tree_;
  PanelFactor& factor_;
  SubtreeGroups groups_;
  std::vector<int> place_;     // per column, within its group or the top
  std::vector<int> group_of_;  // per column
  std::vector<int> first_panel_;
};

PanelFactor::PanelFactor(const SparseMatrix& A, const SupernodeTree& tree, SimdLevel level,
                         TaskPool* pool, const std::function<void(double bytes)>& begin)
    : size_(tree.size), kernels_(&panel_kernels(level)) {
  Layout layout(tree, *this);
  if (begin) begin(bytes());
  factorise_fronts(
      A, tree,
      [&layout](int s, int first, int end, const double* corner, std::ptrdiff_t stride) {
        layout.fill(s, first, end, corner, stride);
      },
      pool);
}

PanelFactor::PanelFactor(const Supernodes& source, SimdLevel level)
    : size_(source.size), kernels_(&panel_kernels(level)) {
  const SupernodeTree tree = supernode_tree(source);
  Layout layout(tree, *this);
  const double* read = source.values;
  for (int s = 0; s < source.count; ++s) {
    const int stride = source.num_rows(s);
    const double* values = source.values + source.values_begin[s];
    for (int begin = 0; begin < source.columns(s); begin += kPanelColumns) {
      layout.fill(s, begin, std::min(begin + kPanelColumns, source.columns(s)),
                  values + static_cast<std::ptrdiff_t>(begin) * stride + begin, stride);
    }
    const double* end = values + static_cast<std::ptrdiff_t>(stride) * source.columns(s);
    if (!source.used_up || end - read < kGivenUp) continue;
    give_up_pages(read, end);  // so that both never exist as a whole
    read = end;
  }
}

int PanelFactor::top_place(int group) const {
  const Group& g = groups_[static_cast<std::size_t>(group)];
  return g.first + g.columns;
}

void PanelFactor::solve(const double* B, double* X, Eigen::Index columns, Eigen::Index stride,
                        Workspace& work, TaskPool* pool) const {
  std::array<const double*, kMostSides> from{};
  std::array<double*, kMostSides> to{};
  for (Eigen::Index done = 0; done < columns; done += kMostSides) {
    const Eigen::Index some = std::min<Eigen::Index>(kMostSides, columns - done);
    for (Eigen::Index k = 0; k < some; ++k) {
      from[static_cast<std::size_t>(k)] = B + (done + k) * stride;
      to[static_cast<std::size_t>(k)] = X + (done + k) * stride;
    }
    solve_some(from.data(), to.data(), static_cast<int>(some), work, pool);
  }
}

void PanelFactor::solve_in_place(std::span<double* const> vectors, Workspace& work,
                                 TaskPool* pool) const {
  for (std::size_t done = 0; done < vectors.size(); done += kMostSides) {
    const std::size_t some = std::min<std::size_t>(kMostSides, vectors.size() - done);
    double* const* X = vectors.data() + done;
    solve_some(X, X, static_cast<int>(some), work, pool);
  }
}

void PanelFactor::solve_some(const double* const* B, double* const* X, int columns, Workspace& work,
                             TaskPool* pool) const {
  const int unit = side_multiple();
  const int sides = columns == 1 ? 1 : (columns + unit - 1) / unit * unit;
  const auto needed = static_cast<std::size_t>(num_places_) * static_cast<std::size_t>(sides);
  if (work.values.size() < needed) work.values = StreamingMemory(needed);
  double* x = work.values.data();
  const Panel* panels = panels_.data();
  run_tasks(pool, num_groups(), [&](int g) {
    const Group& group = groups_[static_cast<std::size_t>(g)];
    gather(g, B, columns, sides, x);
    kernels_->forward(panels + group.panels_begin, panels + group.panels_end, x, sides);
  });
  solve_top(x, sides);
  run_tasks(pool, num_groups(), [&](int g) {
    const Group& group = groups_[static_cast<std::size_t>(g)];
    if (g > 0) {
      const double* top = x + static_cast<std::ptrdiff_t>(top_place(0)) * sides;
      std::copy(top, top + static_cast<std::ptrdiff_t>(top_columns_) * sides,
                x + static_cast<std::ptrdiff_t>(top_place(g)) * sides);
    }
    kernels_->backward(panels + group.panels_begin, panels + group.panels_end, x, sides);
    scatter(g, x, sides, columns, X);
  });
}

void PanelFactor::solve_top(double* x, int sides) const {
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(top_columns_) * sides;
  double* top = x + static_cast<std::ptrdiff_t>(top_place(0)) * sides;
  for (int g = 1; g < num_groups(); ++g) {
    const double* other = x + static_cast<std::ptrdiff_t>(top_place(g)) * sides;
    for (std::ptrdiff_t k = 0; k < count; ++k) top[k] += other[k];
  }
  const Panel* begin = panels_.data() + top_begin_;
  const Panel* end = panels_.data() + panels_.size();
  kernels_->forward(begin, end, x, sides);
  kernels_->backward(begin, end, x, sides);
}

void PanelFactor::gather(int group, const double* const* B, int columns, int sides,
                         double* x) const {
  const Group& g = groups_[static_cast<std::size_t>(group)];
  const int end = g.first + g.columns + top_columns_ + 1;
  for (int p = g.first; p < end; ++p) {
    double* to = x + static_cast<std::ptrdiff_t>(p) * sides;
    const int row = origin_[static_cast<std::size_t>(p)];
    for (int r = 0; r < sides; ++r) to[r] = row >= 0 && r < columns ? B[r][row] : 0.0;
  }
}

void PanelFactor::scatter(int group, const double* x, int sides, int columns,
                          double* const* X) const {
  const Group& g = groups_[static_cast<std::size_t>(group)];
  const int end = g.first + g.columns + top_columns_;
  for (int p = g.first; p < end; ++p) {
    const int row = origin_[static_cast<std::size_t>(p)];
    if (row < 0) continue;
    const double* from = x + static_cast<std::ptrdiff_t>(p) * sides;
    for (int r = 0; r < columns; ++r) X[r][row] = from[r];
  }
}

}  // namespace buckens::linalg
