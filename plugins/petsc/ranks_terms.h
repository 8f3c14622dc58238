// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "ranks_parts.h"

namespace buckens_petsc {

/// Of each term of a sum an entry, zero where it has none.
using TermValues = std::array<double, kBuckensMostProducts>;

/// Calls visit(row, values) for the entries of a column of a sum from a row on, rows ascending.
template <class Matrix, class Visitor>
void visit_column(const std::vector<const Matrix*>& terms, int column, int least_row,
                  Visitor&& visit) {
  std::array<KeptColumns::Column, kBuckensMostProducts> of{};
  std::array<int, kBuckensMostProducts> at{};
  const auto row_of = [&](std::size_t t) {
    return terms[t]->variables[static_cast<std::size_t>(of[t].row(at[t]))];
  };
  const auto is_left = [&](std::size_t t) { return at[t] < of[t].size; };
  for (std::size_t t = 0; t < terms.size(); ++t) {
    of[t] = terms[t]->columns.column(column);
    while (is_left(t) && row_of(t) < least_row) ++at[t];
  }
  for (;;) {
    int row = -1;
    for (std::size_t t = 0; t < terms.size(); ++t) {
      if (is_left(t) && (row < 0 || row_of(t) < row)) row = row_of(t);
    }
    if (row < 0) return;
    TermValues values{};
    for (std::size_t t = 0; t < terms.size(); ++t) {
      if (is_left(t) && row_of(t) == row) values[t] = of[t].value(at[t]++);
    }
    visit(row, values);
  }
}

/// Terms added in their order.
inline double weighted(const TermValues& values, const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t t = 0; t < weights.size(); ++t) sum += weights[t] * values[t];
  return sum;
}

}  // namespace buckens_petsc
