// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

namespace buckens::linalg {

/// Where the lower part of a dense matrix lies in memory: blocks of kBlock columns, each with the
/// rows from its diagonal down, column by column. Half the memory of a whole square.
struct Trapezoid {
  /// Products of such blocks spend a sixteenth of their time on preparing their factors; larger
  /// blocks leave too few for several threads.
  static constexpr int kBlock = 512;

  int rows = 0;
  int columns = 0;  ///< at most `rows`

  int blocks() const { return (columns + kBlock - 1) / kBlock; }
  /// Columns of block p.
  int width(int p) const { return std::min(kBlock, columns - p * kBlock); }
  /// From column to column of block p.
  int stride(int p) const { return rows - p * kBlock; }
  /// Of the diagonal entry that block p begins with.
  std::ptrdiff_t offset(int p) const {
    const std::ptrdiff_t before = p;
    return kBlock * before * rows - std::ptrdiff_t{kBlock} * kBlock * (before * (before - 1) / 2);
  }
  std::ptrdiff_t size() const {
    if (columns == 0) return 0;
    const int last = blocks() - 1;
    return offset(last) + static_cast<std::ptrdiff_t>(stride(last)) * width(last);
  }
  /// Entries of column j: [i] is that of row i, for i from the diagonal of its block on.
  template <class T>
  T* column(T* values, int j) const {
    const int p = j / kBlock;
    const int first = p * kBlock;
    return values + (offset(p) - first + static_cast<std::ptrdiff_t>(j - first) * stride(p));
  }
  /// Row `row` of the first column of block p.
  double* block(double* values, int p, int row) const {
    return values + (offset(p) + row - p * kBlock);
  }
};

}  // namespace buckens::linalg
