// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_factor.h"

#include <algorithm>
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
    for (int g = 0; g < groups_.count(); ++g) {
      for (int s = 0; s < tree_.count; ++s) {
        if (group_of_supernode(s) != g) continue;
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
    factor_.groups_.resize(static_cast<std::size_t>(groups_.count()));
    for_all_columns([this](int g, int c) {
      place_[static_cast<std::size_t>(c)] = group(g).columns++;
      group_of_[static_cast<std::size_t>(c)] = g;
    });
    connect_groups();
    for (Group& g : factor_.groups_) {
      if (!g.is_leaf()) {
        g.first = group(g.below[0]).first + group(g.below[0]).columns;
        continue;
      }
      g.first = factor_.num_places_;
      factor_.num_places_ += g.size() + 1;
    }
    factor_.origin_.assign(static_cast<std::size_t>(factor_.num_places_), -1);
    for_all_columns([this](int g, int c) {
      factor_.origin_[static_cast<std::size_t>(place(c, g))] =
          tree_.permutation[static_cast<std::size_t>(c)];
    });
  }

  void connect_groups() {
    for (int g = groups_.count(); g-- > 0;) {  // parents first
      group(g).parent = groups_.parent[static_cast<std::size_t>(g)];
      if (group(g).parent != kNone) group(g).above = group(group(g).parent).size();
    }
    for (int g = 0; g < groups_.count(); ++g) {
      if (group(g).parent == kNone) continue;
      int* below = group(group(g).parent).below;
      below[below[0] == kNone ? 0 : 1] = g;
    }
  }

  Group& group(int g) { return factor_.groups_[static_cast<std::size_t>(g)]; }
  int group_of_supernode(int s) const { return groups_.group[static_cast<std::size_t>(s)]; }
  /// Where group g finds a column of its own or of a group above it.
  int place(int column, int g) {
    const auto c = static_cast<std::size_t>(column);
    return group(g).first + group(g).size() - group(group_of_[c]).size() + place_[c];
  }
  int missing_place(int g) { return group(g).first + group(g).size(); }

  void count() {
    std::ptrdiff_t lines = 0;
    std::size_t rows = 0;
    for_all_panels([&](int s, int begin, int end) {
      const int g = group_of_supernode(s);
      Panel panel{};
      const int first = tree_.first_column[static_cast<std::size_t>(s)];
      panel.first = place(first + begin, g);
      panel.columns = end - begin;
      const int below = tree_.columns(s) + tree_.rows_below(s) - end;
      panel.row_blocks = (below + kPanelRows - 1) / kPanelRows;
      lines += panel.num_lines();
      rows += static_cast<std::size_t>(kPanelRows * panel.row_blocks);
      const int before = static_cast<int>(factor_.panels_.size());
      if (begin == 0) first_panel_[static_cast<std::size_t>(s)] = before;
      factor_.panels_.push_back(panel);
      ++group(g).panels_end;  // counts them until all are there
    });
    int end = 0;
    for (Group& g : factor_.groups_) {
      g.panels_begin = end;
      g.panels_end = end += g.panels_end;
    }
    factor_.values_ = StreamingMemory(static_cast<std::size_t>(kPanelRows * lines));
    factor_.rows_.reserve(rows);  // panels keep pointers into it
  }

  void place_rows() {
    std::size_t next = 0;
    const double* values = factor_.values_.data();
    for_all_panels([&](int s, int begin, int end) {
      const int g = group_of_supernode(s);
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

PanelFactor::PanelFactor(const MatrixSum& A, const SupernodeTree& tree, SimdLevel level,
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

double PanelFactor::busiest_share(int threads) const {
  std::vector<int> parent;
  std::vector<double> weight;
  for (const Group& g : groups_) {
    parent.push_back(g.parent);
    weight.push_back(0.0);
    for (int k = g.panels_begin; k < g.panels_end; ++k) {
      weight.back() += static_cast<double>(panels_[static_cast<std::size_t>(k)].num_lines());
    }
  }
  return linalg::busiest_share(parent, weight, threads);
}

}  // namespace buckens::linalg
