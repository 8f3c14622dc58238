// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/constraint/coupled_nodes.h"

#include <algorithm>

#include "buckens/linalg/matrix_sum.h"

namespace buckens::fem {

namespace {

// A third node must be nearer by this share: the diagonal of a square is longer than its sides by
// 41 %, rounding makes equal lengths differ by 1e-16.
constexpr double kNearer = 1.0 - 1e-9;

std::vector<std::vector<int>> neighbours(const FeModel& fe) {
  std::vector<int> node_of(static_cast<std::size_t>(fe.dofs.num_dofs), -1);
  for (std::size_t node = 0; node < fe.dofs.node_dofs.size(); ++node) {
    for (const int dof : fe.dofs.node_dofs[node]) {
      if (dof >= 0) node_of[static_cast<std::size_t>(dof)] = static_cast<int>(node);
    }
  }
  std::vector<std::vector<int>> out(fe.nodes.size());
  linalg::MatrixSum K;
  K.add(1.0, fe.K);
  std::vector<linalg::MatrixSum::Entry> entries;
  for (int column = 0; column < fe.dofs.num_dofs; ++column) {
    const int own = node_of[static_cast<std::size_t>(column)];
    K.read_column(column, entries);
    for (const auto& [row, value] : entries) {
      const int other = node_of[static_cast<std::size_t>(row)];
      if (other != own && value != 0.0) out[static_cast<std::size_t>(own)].push_back(other);
    }
  }
  for (auto& list : out) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return out;
}

}  // namespace

std::vector<std::array<int, 2>> coupled_nodes(const FeModel& fe) {
  const auto near = neighbours(fe);
  const auto distance = [&fe](int a, int b) {
    return (fe.nodes[static_cast<std::size_t>(a)].position -
            fe.nodes[static_cast<std::size_t>(b)].position)
        .norm();
  };
  std::vector<std::array<int, 2>> out;
  std::vector<int> common;
  for (int a = 0; a < static_cast<int>(near.size()); ++a) {
    const auto& of_a = near[static_cast<std::size_t>(a)];
    for (const int b : of_a) {
      if (b < a) continue;
      const auto& of_b = near[static_cast<std::size_t>(b)];
      common.clear();
      std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                            std::back_inserter(common));
      const double length = distance(a, b);
      const bool has_between = std::any_of(common.begin(), common.end(), [&](int c) {
        return std::max(distance(a, c), distance(b, c)) < kNearer * length;
      });
      if (!has_between) out.push_back({a, b});
    }
  }
  return out;
}

}  // namespace buckens::fem
