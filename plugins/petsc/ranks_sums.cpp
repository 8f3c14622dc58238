// SPDX-License-Identifier: Apache-2.0
// Sums of matrices that the first process has given away.
#include <vector>

#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {

/// Calls visit(row, value) for the entries of a column of a sum from the diagonal on, rows
/// ascending, terms added in their order.
template <class Matrix, class Visitor>
void visit_column(const std::vector<const Matrix*>& terms, const double* weights, int column,
                  int least_row, std::vector<int>& at, Visitor&& visit) {
  const auto row_of = [&](std::size_t t) {
    return terms[t]->variables[static_cast<std::size_t>(terms[t]->rows[at[t]])];
  };
  const auto is_left = [&](std::size_t t) { return at[t] < terms[t]->starts[column + 1]; };
  for (std::size_t t = 0; t < terms.size(); ++t) {
    at[t] = terms[t]->starts[column];
    while (is_left(t) && row_of(t) < least_row) ++at[t];
  }
  for (;;) {
    int row = -1;
    for (std::size_t t = 0; t < terms.size(); ++t) {
      if (is_left(t) && (row < 0 || row_of(t) < row)) row = row_of(t);
    }
    if (row < 0) return;
    double value = 0;
    for (std::size_t t = 0; t < terms.size(); ++t) {
      if (is_left(t) && row_of(t) == row) value += weights[t] * terms[t]->values[at[t]++];
    }
    visit(row, value);
  }
}

}  // namespace

/// Each process forms its columns of the lower triangle of a sum of divided matrices.
bool Ranks::sum_terms(const Order& order, const BuckensGridMatrix* matrix, OwnRows& own) {
  std::vector<const Divided*> terms;
  for (int k = 0; k < order.num_matrices(); ++k) {
    terms.push_back(shared_->matrices.at(order.of[static_cast<std::size_t>(k)]).get());
  }
  std::vector<double> weights(terms.size());
  if (matrix != nullptr) weights.assign(matrix->weights, matrix->weights + terms.size());
  MPI_Bcast(weights.data(), static_cast<int>(weights.size()), MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, sizeof(double) * static_cast<double>(weights.size()));
  const int first = terms.front()->first[rank_];
  const int count = terms.front()->counts[rank_];
  return has_memory_for([&] {
    std::vector<int> at(terms.size());
    const auto visit = [&](int column, auto&& visitor) {
      visit_column(terms, weights.data(), column, first + column, at, visitor);
    };
    own.starts.assign(static_cast<std::size_t>(count) + 1, 0);
    for (int column = 0; column < count; ++column) {
      int& end = own.starts[static_cast<std::size_t>(column) + 1];
      end = own.starts[static_cast<std::size_t>(column)];
      visit(column, [&end](int, double) { ++end; });
    }
    own.rows.reserve(static_cast<std::size_t>(own.starts.back()));
    own.values.reserve(own.rows.capacity());
    for (int column = 0; column < count; ++column) {
      visit(column, [&own](int row, double value) {
        own.rows.push_back(row);
        own.values.push_back(value);
      });
    }
    own.columns = {own.starts.data(), own.rows.data(), own.values.data()};
  });
}

}  // namespace buckens_petsc
