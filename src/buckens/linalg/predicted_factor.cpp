// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/predicted_factor.h"

#include <algorithm>
#include <vector>

#include "buckens/linalg/front.h"
#include "buckens/linalg/panel_kernels.h"
#include "buckens/linalg/supernode_tree.h"

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

}  // namespace

PredictedFactor predict_factor(const SparseMatrix& A) {
  const SupernodeTree tree = find_supernode_tree(A);
  std::vector<double> waiting(static_cast<std::size_t>(tree.count));  // rests of the children
  double used = 0, most = 0;                                          // by fronts
  PredictedFactor out;
  for (int s = 0; s < tree.count; ++s) {  // children before their parents
    const Front front(tree.columns(s), tree.rows_below(s));
    const auto own = static_cast<double>(front.own_size()) * sizeof(double);
    const auto rest = static_cast<double>(front.rest_size()) * sizeof(double);
    out.bytes += bytes_in_panels(tree.columns(s), tree.rows_below(s));
    most = std::max(most, used + own + rest);
    used += rest - waiting[static_cast<std::size_t>(s)];
    const int parent = tree.parent[static_cast<std::size_t>(s)];
    if (parent >= 0) waiting[static_cast<std::size_t>(parent)] += rest;
  }
  out.peak = out.bytes + most;
  return out;
}

double most_factor_bytes(Eigen::Index size) {
  return 0.5 * sizeof(double) * static_cast<double>(size) * static_cast<double>(size + 1);
}

}  // namespace buckens::linalg
