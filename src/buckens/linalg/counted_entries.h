// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A sparse matrix that takes no more memory than its entries, which are gone through twice: to
/// count them and to store them.
/// @param visit calls the function that it gets as entry(row, column, value), columns in any order;
///              their rows are stored as they come
template <class Visit>
SparseMatrix from_counted_entries(int rows, int columns, Visit&& visit) {
  SparseMatrix out(rows, columns);
  int* starts = out.outerIndexPtr();
  std::fill_n(starts, columns + 1, 0);
  visit([starts](int, int column, double) { ++starts[column + 1]; });
  std::partial_sum(starts, starts + columns + 1, starts);
  out.resizeNonZeros(starts[columns]);
  std::vector<int> next(starts, starts + columns);
  visit([&](int row, int column, double value) {
    const int place = next[static_cast<std::size_t>(column)]++;
    out.innerIndexPtr()[place] = row;
    out.valuePtr()[place] = value;
  });
  return out;
}

}  // namespace buckens::linalg
