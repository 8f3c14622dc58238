// SPDX-License-Identifier: Apache-2.0
// Matrices that the first process has given away, and products with them.
#include <new>
#include <numeric>

#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {

/// Runs of columns of the processes other than the first, which holds everything else of a body.
std::vector<int> runs_of_columns(int size, int count) {
  std::vector<int> first = {0};
  for (int k = 0; k < count; ++k) {
    first.push_back(static_cast<int>(static_cast<long>(size) * k / (count - 1)));
  }
  return first;
}

std::vector<int> starts_of(const std::vector<int>& counts) {
  std::vector<int> first(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), first.begin() + 1);
  return first;
}

/// Replaces rows by places in the list of those that occur.
void list_rows(int size, std::vector<int>& rows, std::vector<int>& variables) {
  std::vector<int> place(static_cast<std::size_t>(size), -1);
  for (const int row : rows) place[static_cast<std::size_t>(row)] = 0;
  variables.reserve(
      static_cast<std::size_t>(size + std::accumulate(place.begin(), place.end(), 0)));
  for (int row = 0; row < size; ++row) {
    int& at = place[static_cast<std::size_t>(row)];
    if (at < 0) continue;
    at = static_cast<int>(variables.size());
    variables.push_back(row);
  }
  for (int& row : rows) row = place[static_cast<std::size_t>(row)];
}

template <class Action>
bool has_memory_for(Action&& action) try {
  action();
  return true;
} catch (const std::bad_alloc&) {
  set_reason("there is too little memory for the rows of the matrix");
  return false;
}

}  // namespace

int Ranks::divide(int size, const BuckensGridColumns& all) {
  Order order;
  order.task = Task::divide;
  order.number = next_++;
  order.size = size;
  give(order);
  return divide_together(order, &all) ? order.number : -1;
}

bool Ranks::divide_together(const Order& order, const BuckensGridColumns* all) {
  auto matrix = std::make_unique<Divided>();
  matrix->size = order.size;
  matrix->first = runs_of_columns(order.size, count_);
  for (int k = 0; k < count_; ++k) {
    matrix->counts.push_back(matrix->first[k + 1] - matrix->first[k]);
  }
  std::vector<int> entries(static_cast<std::size_t>(count_), 0);
  for (int k = 0; k < count_ && all != nullptr; ++k) {
    entries[k] = all->starts[matrix->first[k + 1]] - all->starts[matrix->first[k]];
  }
  MPI_Bcast(entries.data(), count_, MPI_INT, 0, work_);
  count_messages(count_ - 1, sizeof(int) * static_cast<double>(count_));
  const auto mine = static_cast<std::size_t>(entries[rank_]);
  const bool has_room = has_memory_for([&] {
    matrix->starts.resize(static_cast<std::size_t>(matrix->counts[rank_]) + 1);
    matrix->rows.resize(mine);
    matrix->values.resize(mine);
  });
  if (has_failed_somewhere(!has_room)) return false;
  exchange_columns(all, *matrix);
  const bool is_listed =
      has_memory_for([&] { list_rows(matrix->size, matrix->rows, matrix->variables); });
  if (has_failed_somewhere(!is_listed)) return false;
  exchange_lists(*matrix);
  shared_->matrices[order.number] = std::move(matrix);
  return true;
}

void Ranks::exchange_columns(const BuckensGridColumns* all, Divided& matrix) {
  if (all == nullptr) {
    receive(matrix.starts.data(), matrix.starts.size(), 0, work_);
    receive(matrix.rows.data(), matrix.rows.size(), 0, work_);
    receive(matrix.values.data(), matrix.values.size(), 0, work_);
    for (std::size_t k = matrix.starts.size(); k-- > 0;) matrix.starts[k] -= matrix.starts[0];
    return;
  }
  for (int k = 1; k < count_; ++k) {
    const int* starts = all->starts + matrix.first[k];
    const auto entries = static_cast<std::size_t>(starts[matrix.counts[k]] - starts[0]);
    send_counted(starts, static_cast<std::size_t>(matrix.counts[k]) + 1, k);
    send_counted(all->rows + starts[0], entries, k);
    send_counted(all->values + starts[0], entries, k);
  }
}

/// Tells the first process which variables the columns of each have.
void Ranks::exchange_lists(Divided& matrix) {
  const int here = static_cast<int>(matrix.variables.size());
  matrix.list_counts.resize(static_cast<std::size_t>(count_));
  MPI_Gather(&here, 1, MPI_INT, matrix.list_counts.data(), 1, MPI_INT, 0, work_);
  if (rank_ == 0) {
    matrix.list_first = starts_of(matrix.list_counts);
    matrix.lists.resize(static_cast<std::size_t>(matrix.list_first.back()));
  }
  MPI_Gatherv(matrix.variables.data(), here, MPI_INT, matrix.lists.data(),
              matrix.list_counts.data(), matrix.list_first.data(), MPI_INT, 0, work_);
  count_messages(count_ - 1, sizeof(int));
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(int) * static_cast<double>(matrix.lists.size());
}

void Ranks::multiply(int count, const int* matrices, const double* const* x, double* const* y) {
  Order order;
  order.task = Task::multiply;
  order.set_matrices(matrices, count);
  give(order);
  multiply_together(order, x, y);
}

/// One message to each process, with what its rows need of all x, and one back, with its rows of
/// all y.
void Ranks::multiply_together(const Order& order, const double* const* x, double* const* y) {
  std::vector<const Divided*> matrices;
  for (int k = 0; k < order.num_matrices(); ++k) {
    matrices.push_back(shared_->matrices.at(order.of[static_cast<std::size_t>(k)]).get());
  }
  if (rank_ == 0) {
    ask_for_products(matrices, x, y);
  } else {
    form_products(matrices);
  }
}

void Ranks::ask_for_products(const std::vector<const Divided*>& matrices, const double* const* x,
                             double* const* y) {
  std::vector<int> there(static_cast<std::size_t>(count_), 0), back(there);
  for (const Divided* A : matrices) {
    for (int k = 1; k < count_; ++k) {
      there[k] += A->list_counts[k];
      back[k] += A->counts[k];
    }
  }
  const std::vector<int> there_first = starts_of(there), back_first = starts_of(back);
  std::vector<double>& sent = shared_->sent;
  std::vector<double>& received = shared_->received;
  sent.resize(static_cast<std::size_t>(there_first.back()));
  received.resize(static_cast<std::size_t>(back_first.back()));
  auto next = sent.begin();
  for (int k = 1; k < count_; ++k) {
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      const int* list = matrices[m]->lists.data() + matrices[m]->list_first[k];
      next = std::transform(list, list + matrices[m]->list_counts[k], next,
                            [from = x[m]](int variable) { return from[variable]; });
    }
  }
  MPI_Scatterv(sent.data(), there.data(), there_first.data(), MPI_DOUBLE, nullptr, 0, MPI_DOUBLE, 0,
               work_);
  MPI_Gatherv(nullptr, 0, MPI_DOUBLE, received.data(), back.data(), back_first.data(), MPI_DOUBLE,
              0, work_);
  auto from = received.begin();
  for (int k = 1; k < count_; ++k) {
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      const auto end = from + matrices[m]->counts[k];
      std::copy(from, end, y[m] + matrices[m]->first[k]);
      from = end;
    }
  }
  count_messages(2 * (count_ - 1), 0);
  traffic_.bytes += sizeof(double) * static_cast<double>(sent.size() + received.size());
}

void Ranks::form_products(const std::vector<const Divided*>& matrices) {
  std::size_t there = 0, back = 0;
  for (const Divided* A : matrices) {
    there += A->variables.size();
    back += static_cast<std::size_t>(A->counts[rank_]);
  }
  std::vector<double>& received = shared_->received;
  std::vector<double>& sent = shared_->sent;
  received.resize(there);
  sent.resize(back);
  MPI_Scatterv(nullptr, nullptr, nullptr, MPI_DOUBLE, received.data(), static_cast<int>(there),
               MPI_DOUBLE, 0, work_);
  const double* at = received.data();
  double* out = sent.data();
  for (const Divided* A : matrices) {
    for (int row = 0; row < A->counts[rank_]; ++row) {
      double sum = 0;
      for (int e = A->starts[row]; e < A->starts[row + 1]; ++e) {
        sum += A->values[e] * at[A->rows[e]];
      }
      *out++ = sum;
    }
    at += A->variables.size();
  }
  MPI_Gatherv(sent.data(), static_cast<int>(back), MPI_DOUBLE, nullptr, nullptr, nullptr,
              MPI_DOUBLE, 0, work_);
}

void Ranks::gather(int matrix, int* starts, int* rows, double* values) {
  Order order;
  order.task = Task::gather;
  order.number = matrix;
  give(order);
  gather_together(order, starts, rows, values);
}

void Ranks::gather_together(const Order& order, int* starts, int* rows, double* values) {
  const Divided& matrix = *shared_->matrices.at(order.number);
  if (rank_ != 0) {
    send(matrix.starts.data(), matrix.starts.size(), 0, work_);
    send(matrix.rows.data(), matrix.rows.size(), 0, work_);
    send(matrix.values.data(), matrix.values.size(), 0, work_);
    return;
  }
  int next = 0;
  for (int k = 1; k < count_; ++k) {
    int* own = starts + matrix.first[k];
    receive(own, static_cast<std::size_t>(matrix.counts[k]) + 1, k, work_);
    const auto entries = static_cast<std::size_t>(own[matrix.counts[k]]);
    receive(rows + next, entries, k, work_);
    receive(values + next, entries, k, work_);
    const int* list = matrix.lists.data() + matrix.list_first[k];
    std::transform(rows + next, rows + next + entries, rows + next,
                   [list](int place) { return list[place]; });
    for (int column = 0; column <= matrix.counts[k]; ++column) own[column] += next;
    next += static_cast<int>(entries);
    count_messages(3, 0);
    traffic_.bytes += static_cast<double>(sizeof(int) * (matrix.counts[k] + std::size_t{1}) +
                                          entries * (sizeof(int) + sizeof(double)));
  }
}

void Ranks::forget(int matrix) {
  give(Task::forget, matrix);
  shared_->matrices.erase(matrix);
}

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
