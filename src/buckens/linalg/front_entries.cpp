// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/front_entries.h"

#include <cstddef>

namespace buckens::linalg {

namespace {
std::size_t column_at(int k) { return static_cast<std::size_t>(k); }
}  // namespace

FrontEntries::FrontEntries(const MatrixSum& A, const SupernodeTree& tree)
    : A_(A), tree_(tree), place_(column_at(tree.size)) {
  for (int c = 0; c < tree.size; ++c) place_[column_at(tree.permutation[column_at(c)])] = c;
}

void FrontEntries::add(int s, const Front& front, std::vector<int>& local) const {
  const int first = tree_.first_column[column_at(s)];
  int row = 0;
  for (int c = first; c < tree_.first_column[column_at(s + 1)]; ++c) local[column_at(c)] = row++;
  const int* rows = tree_.rows_of(s);
  for (int k = 0; k < tree_.rows_below(s); ++k) local[column_at(rows[k])] = row++;

  std::vector<MatrixSum::Entry> entries;
  for (int j = 0; j < tree_.columns(s); ++j) {
    double* to = front.column(j);
    A_.read_column(tree_.permutation[column_at(first + j)], entries);
    for (const auto& [of, value] : entries) {
      const int c = place_[column_at(of)];
      if (c >= first + j) to[local[column_at(c)]] += value;
    }
  }
}

}  // namespace buckens::linalg
