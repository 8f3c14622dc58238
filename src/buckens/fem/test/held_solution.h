// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "buckens/fem/fe_model.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::fem::test {

/// Solves K d = f with some DOF prescribed.
inline linalg::Vector solve(const FeModel& fe, const linalg::Vector& f,
                            const std::vector<bool>& given, linalg::Vector d) {
  std::vector<int> number(given.size(), -1);
  int free = 0;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (!given[k]) number[k] = free++;
  }
  const linalg::Vector load = f - fe.K * d;
  std::vector<linalg::Triplet> entries;
  linalg::Vector x(free);
  for (int column = 0; column < fe.K.whole().outerSize(); ++column) {
    const int j = number[static_cast<std::size_t>(column)];
    if (j < 0) continue;
    x[j] = load[column];
    for (linalg::SparseMatrix::InnerIterator it(fe.K.whole(), column); it; ++it) {
      const int i = number[static_cast<std::size_t>(it.row())];
      if (i >= 0) entries.emplace_back(i, j, it.value());
    }
  }
  linalg::SparseMatrix K(free, free);
  K.setFromTriplets(entries.begin(), entries.end());
  linalg::SparseCholesky(K).solve_in_place(x);
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (number[k] >= 0) d[static_cast<Eigen::Index>(k)] += x[number[k]];
  }
  return d;
}

}  // namespace buckens::fem::test
