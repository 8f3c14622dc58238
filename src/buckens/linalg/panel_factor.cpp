// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_factor.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Dense>

#include "buckens/linalg/subtree_groups.h"

namespace buckens::linalg {

namespace {

// Bytes from which two threads pay: their start costs as much as some 50 kB of reading each.
constexpr double kShared = 4e6;
// Values of the source released at a time: enough to make the call negligible.
constexpr std::ptrdiff_t kGivenUp = std::ptrdiff_t{1} << 20;

using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

std::vector<int> supernode_parents(const Supernodes& source) {
  std::vector<int> supernode_of(static_cast<std::size_t>(source.size));
  for (int s = 0; s < source.count; ++s) {
    std::fill(supernode_of.begin() + source.first_column[s],
              supernode_of.begin() + source.first_column[s + 1], s);
  }
  std::vector<int> parent(static_cast<std::size_t>(source.count), -1);
  for (int s = 0; s < source.count; ++s) {
    if (source.num_rows(s) == source.columns(s)) continue;
    const int first_below = source.rows[source.rows_begin[s] + source.columns(s)];
    parent[static_cast<std::size_t>(s)] = supernode_of[static_cast<std::size_t>(first_below)];
  }
  return parent;
}

std::vector<double> supernode_bytes(const Supernodes& source) {
  std::vector<double> bytes(static_cast<std::size_t>(source.count));
  for (int s = 0; s < source.count; ++s) {
    const double columns = source.columns(s);
    bytes[static_cast<std::size_t>(s)] = 8.0 * columns * (source.num_rows(s) - 0.5 * columns);
  }
  return bytes;
}

}  // namespace

/// Fills a PanelFactor, supernode by supernode.
class PanelFactor::Layout {
 public:
  Layout(const Supernodes& source, PanelFactor& factor)
      : source_(source),
        factor_(factor),
        groups_(group_subtrees(supernode_parents(source), supernode_bytes(source), kShared)),
        place_(static_cast<std::size_t>(source.size)) {}

  void make() {
    place_columns();
    count();
    std::size_t next_panel = 0;
    std::ptrdiff_t next_value = 0;
    for_all_panels([&](int s, int begin, int end) {
      Panel& panel = factor_.panels_[next_panel++];
      double* values = factor_.values_.data() + next_value;
      panel.values = values;
      next_value += kPanelRows * panel.num_lines();
      fill_triangle(s, begin, end, panel, values);
      fill_rows(s, begin, end, panel, values);
      if (source_.used_up && end == source_.columns(s)) give_up(s);
    });
  }

 private:
  /// f(supernode, first, end of its columns) in the order of memory.
  template <class F>
  void for_all_panels(F&& f) {
    for (int g = 0; g <= groups_.count; ++g) {
      const int wanted = g < groups_.count ? g : SubtreeGroups::kTop;
      for (int s = 0; s < source_.count; ++s) {
        if (groups_.group[static_cast<std::size_t>(s)] != wanted) continue;
        for (int begin = 0; begin < source_.columns(s); begin += kPanelColumns) {
          f(s, begin, std::min(begin + kPanelColumns, source_.columns(s)));
        }
      }
    }
  }

  void place_columns() {
    factor_.groups_.resize(static_cast<std::size_t>(groups_.count));
    for (int s = 0; s < source_.count; ++s) {
      const int g = groups_.group[static_cast<std::size_t>(s)];
      int& columns = g == SubtreeGroups::kTop ? factor_.top_columns_ : group(g).columns;
      for (int c = source_.first_column[s]; c < source_.first_column[s + 1]; ++c) {
        place_[static_cast<std::size_t>(c)] = columns++;
      }
    }
    for (Group& g : factor_.groups_) {
      g.first = factor_.num_places_;
      factor_.num_places_ += g.columns + factor_.top_columns_ + 1;
    }
    factor_.origin_.assign(static_cast<std::size_t>(factor_.num_places_), -1);
    for (int s = 0; s < source_.count; ++s) {
      const int g = std::max(0, groups_.group[static_cast<std::size_t>(s)]);
      for (int c = source_.first_column[s]; c < source_.first_column[s + 1]; ++c) {
        factor_.origin_[static_cast<std::size_t>(place(c, g))] = source_.permutation[c];
      }
    }
  }

  Group& group(int g) { return factor_.groups_[static_cast<std::size_t>(g)]; }
  int supernode_group(int column) const {
    const int* next =
        std::upper_bound(source_.first_column, source_.first_column + source_.count + 1, column);
    return groups_.group[static_cast<std::size_t>(next - source_.first_column - 1)];
  }
  /// Where group g finds a column of its own or of the top.
  int place(int column, int g) {
    const int within = place_[static_cast<std::size_t>(column)];
    return supernode_group(column) == SubtreeGroups::kTop ? factor_.top_place(g) + within
                                                          : group(g).first + within;
  }
  int missing_place(int g) { return factor_.top_place(g) + factor_.top_columns_; }

  void count() {
    std::ptrdiff_t lines = 0;
    std::size_t rows = 0;
    for_all_panels([&](int s, int begin, int end) {
      const int g = groups_.group[static_cast<std::size_t>(s)];
      Panel panel{};
      panel.first = place(source_.first_column[s] + begin, std::max(0, g));
      panel.columns = end - begin;
      panel.row_blocks = (source_.num_rows(s) - end + kPanelRows - 1) / kPanelRows;
      lines += panel.num_lines();
      rows += static_cast<std::size_t>(kPanelRows * panel.row_blocks);
      factor_.panels_.push_back(panel);
      const int count = static_cast<int>(factor_.panels_.size());
      if (g == SubtreeGroups::kTop) return;
      group(g).panels_end = count;
      if (g + 1 < groups_.count) group(g + 1).panels_begin = group(g + 1).panels_end = count;
      factor_.top_begin_ = count;
    });
    factor_.values_ = StreamingMemory(static_cast<std::size_t>(kPanelRows * lines));
    factor_.rows_.reserve(rows);  // panels keep pointers into it
  }

  void fill_triangle(int s, int begin, int end, const Panel& panel, double*& values) {
    const int ld = source_.num_rows(s);
    const double* corner =
        source_.values + source_.values_begin[s] + static_cast<std::ptrdiff_t>(begin) * ld + begin;
    const Block L(corner, end - begin, end - begin, Eigen::OuterStride<>(ld));
    inverse_.setIdentity(end - begin, end - begin);
    L.triangularView<Eigen::Lower>().solveInPlace(inverse_);
    for (int b = 0; b < panel.triangle_blocks(); ++b) {
      const int rows = std::min(kPanelRows, panel.columns - kPanelRows * b);
      values = copy_block(inverse_.data() + static_cast<std::ptrdiff_t>(kPanelRows) * b,
                          inverse_.rows(), rows, panel.triangle_columns(b), values);
    }
  }

  void fill_rows(int s, int begin, int end, Panel& panel, double*& values) {
    const int g = std::max(0, groups_.group[static_cast<std::size_t>(s)]);
    const int ld = source_.num_rows(s);
    const double* below =
        source_.values + source_.values_begin[s] + static_cast<std::ptrdiff_t>(begin) * ld + end;
    panel.rows = factor_.rows_.data() + factor_.rows_.size();
    const int* rows = source_.rows + source_.rows_begin[s] + end;
    const int count = ld - end;
    for (int b = 0; b < panel.row_blocks; ++b) {
      const int present = std::min(kPanelRows, count - kPanelRows * b);
      for (int i = 0; i < kPanelRows; ++i) {
        factor_.rows_.push_back(i < present ? place(rows[kPanelRows * b + i], g)
                                            : missing_place(g));
      }
      values = copy_block(below + static_cast<std::ptrdiff_t>(kPanelRows) * b, ld, present,
                          panel.columns, values);
    }
  }

  /// Releases the memory of the source as it is read, so that both never exist as a whole.
  void give_up(int s) {
    const double* begin = source_.values + source_.values_begin[s];
    const double* end = begin + std::ptrdiff_t{source_.num_rows(s)} * source_.columns(s);
    if (begin != read_end_) read_begin_ = begin;
    read_end_ = end;
    if (read_end_ - read_begin_ < kGivenUp) return;
    give_up_pages(read_begin_, read_end_);
    read_begin_ = read_end_;
  }

  /// @param rows present, the others become zero @return past the block
  static double* copy_block(const double* from, Eigen::Index ld, int rows, int columns,
                            double* to) {
    for (int c = 0; c < columns; ++c, from += ld, to += kPanelRows) {
      std::copy(from, from + rows, to);
      std::fill(to + rows, to + kPanelRows, 0.0);
    }
    return to;
  }

  const Supernodes& source_;
  PanelFactor& factor_;
  SubtreeGroups groups_;
  std::vector<int> place_;  // per column, within its group or the top
  Eigen::MatrixXd inverse_;
  const double* read_begin_ = nullptr;  // of the source, not yet released
  const double* read_end_ = nullptr;
};

PanelFactor::PanelFactor(const Supernodes& source, SimdLevel level)
    : size_(source.size), kernels_(&panel_kernels(level)) {
  Layout(source, *this).make();
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
