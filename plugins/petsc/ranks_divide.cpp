// SPDX-License-Identifier: Apache-2.0
// How the first process gives matrices away, and gets them back.
#include <new>
#include <numeric>

#include "abort_alone.h"
#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {

/// Replaces rows by places in the list of those that occur, `first` … `first` + `count` − 1 among
/// them.
void list_rows(int size, int first, int count, std::vector<int>& rows,
               std::vector<int>& variables) {
  std::vector<int> place(static_cast<std::size_t>(size), -1);
  std::fill_n(place.begin() + first, count, 0);
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

/// Calls visit(entry) for those of columns `first` … `end` − 1 that are sent: of a symmetric matrix
/// those on the diagonal or below.
template <class Visitor>
void visit_sent(const BuckensGridColumns& all, bool is_symmetric, int first, int end,
                Visitor&& visit) {
  for (int column = first; column < end; ++column) {
    for (int e = all.starts[column]; e < all.starts[column + 1]; ++e) {
      if (!is_symmetric || all.rows[e] >= column) visit(e);
    }
  }
}

/// The values above the diagonal are taken to be those below it: callers give symmetric matrices,
/// and nothing here compares them. This tells matrices of which one triangle is given.
bool has_entries_of_both_triangles(int size, const BuckensGridColumns& all) {
  int below = 0, above = 0;
  for (int column = 0; column < size; ++column) {
    for (int e = all.starts[column]; e < all.starts[column + 1]; ++e) {
      below += static_cast<int>(all.rows[e] > column);
      above += static_cast<int>(all.rows[e] < column);
    }
  }
  return below == above;
}

template <class T>
std::vector<T> sent_entries(const BuckensGridColumns& all, bool is_symmetric, int first, int end,
                            const T* values, int count) {
  std::vector<T> out;
  out.reserve(static_cast<std::size_t>(count));
  visit_sent(all, is_symmetric, first, end, [&](int e) { out.push_back(values[e]); });
  return out;
}

}  // namespace

int Ranks::divide(int size, const BuckensGridRows& of, const BuckensGridColumns& all,
                  BuckensGridFacts& facts) {
  if (!has_entries_of_both_triangles(size, all)) {
    set_reason("it has entries on one side of the diagonal that are not on the other");
    return -1;
  }
  const Order order = give_new(Task::divide, size, 0, &of);
  return divide_together(order, &of, &all, facts) ? order.number : -1;
}

int Ranks::divide_rows(int rows, int columns, const BuckensGridColumns& all) {
  const Order order = give_new(Task::divide_rows, rows, columns);
  BuckensGridFacts facts{};
  return divide_together(order, nullptr, &all, facts) ? order.number : -1;
}

/// Of all: the first rows of the processes, of which the first has none, and the end.
std::vector<int> Ranks::agreed_runs(const Order& order, const BuckensGridRows* of) {
  std::vector<int> first = runs_of_others(order.size, count_);
  if (order.gives_rows == 0) return first;
  if (of != nullptr) std::copy_n(of->first, count_, first.begin() + 1);
  MPI_Bcast(first.data(), count_ + 1, MPI_INT, 0, work_);
  count_messages(count_ - 1, sizeof(int) * static_cast<double>(count_ + 1));
  return first;
}

/// Of all: which variables those of `matrix.variables` are.
/// @return whether there is memory for their numbers
bool Ranks::agree_on_variables(const Order& order, const BuckensGridRows* of, const Divided& matrix,
                               std::vector<int>& own) {
  std::vector<int> all;
  const bool has_room = has_memory_for([&] {
    own = matrix.variables;
    if (order.gives_rows == 0 || of == nullptr) return;
    for (const int row : matrix.lists) all.push_back(of->variables[row]);
  });
  if (has_failed_somewhere(!has_room)) return false;
  if (order.gives_rows == 0) return true;
  MPI_Scatterv(all.data(), matrix.list_counts.data(), matrix.list_first.data(), MPI_INT, own.data(),
               rank_ == 0 ? 0 : static_cast<int>(own.size()), MPI_INT, 0, work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(int) * static_cast<double>(all.size());
  return true;
}

std::unique_ptr<Ranks::Divided> Ranks::empty_division(const Order& order,
                                                      const BuckensGridRows* of) {
  auto matrix = std::make_unique<Divided>();
  matrix->size = order.size;
  matrix->is_symmetric = order.task != Task::divide_rows && order.task != Task::make_rows;
  matrix->first = agreed_runs(order, of);
  for (int k = 0; k < count_; ++k) {
    matrix->counts.push_back(matrix->first[k + 1] - matrix->first[k]);
  }
  return matrix;
}

bool Ranks::divide_together(const Order& order, const BuckensGridRows* of,
                            const BuckensGridColumns* all, BuckensGridFacts& facts) {
  std::unique_ptr<Divided> matrix = empty_division(order, of);
  std::vector<int> entries(static_cast<std::size_t>(count_), 0);
  for (int k = 0; k < count_ && all != nullptr; ++k) {
    visit_sent(*all, matrix->is_symmetric, matrix->first[k], matrix->first[k + 1],
               [&](int) { ++entries[k]; });
  }
  MPI_Bcast(entries.data(), count_, MPI_INT, 0, work_);
  count_messages(count_ - 1, sizeof(int) * static_cast<double>(count_));
  const auto mine = static_cast<std::size_t>(entries[rank_]);
  OwnRows own;
  const bool has_room = has_memory_for([&] {
    own.starts.resize(static_cast<std::size_t>(matrix->counts[rank_]) + 1);
    own.rows.resize(mine);
    own.values.resize(mine);
  });
  if (has_failed_somewhere(!has_room)) return false;
  exchange_columns(all, *matrix, own);
  return keep(order, of, std::move(matrix), own, facts);
}

/// Of a matrix whose rows are numbers of variables: what all know of it, and their places.
/// @param own columns here; it is empty afterwards
bool Ranks::keep(const Order& order, const BuckensGridRows* of, std::unique_ptr<Divided> matrix,
                 OwnRows& own, BuckensGridFacts& facts) {
  const bool is_listed = has_memory_for([&] {
    const bool lists_own = matrix->is_symmetric;
    list_rows(lists_own ? order.size : order.columns, lists_own ? matrix->first[rank_] : 0,
              lists_own ? matrix->counts[rank_] : 0, own.rows, matrix->variables);
  });
  if (has_failed_somewhere(!is_listed)) return false;
  exchange_lists(*matrix);
  if (matrix->is_symmetric) {
    std::vector<int> variables;
    if (!agree_on_variables(order, of, *matrix, variables)) return false;
    sum_facts(own, variables, facts);
  }
  const bool is_kept = has_memory_for([&] {
    matrix->columns.add(own.starts, own.rows, own.values);
    own = {};
  });
  if (has_failed_somewhere(!is_kept)) return false;
  shared_->matrices[order.number] = std::move(matrix);
  return true;
}

void Ranks::exchange_columns(const BuckensGridColumns* all, const Divided& matrix, OwnRows& own) {
  if (all == nullptr) {
    receive(own.starts.data(), own.starts.size(), 0, work_);
    receive(own.rows.data(), own.rows.size(), 0, work_);
    receive(own.values.data(), own.values.size(), 0, work_);
    return;
  }
  for (int k = 1; k < count_; ++k) {
    const int first = matrix.first[k];
    const int end = matrix.first[k + 1];
    std::vector<int> starts = {0};
    for (int column = first; column < end; ++column) {
      starts.push_back(starts.back());
      visit_sent(*all, matrix.is_symmetric, column, column + 1, [&](int) { ++starts.back(); });
    }
    const int entries = starts.back();
    const auto count = static_cast<std::size_t>(entries);
    send_counted(starts.data(), starts.size(), k);
    const bool is_symmetric = matrix.is_symmetric;
    send_counted(sent_entries(*all, is_symmetric, first, end, all->rows, entries).data(), count, k);
    send_counted(sent_entries(*all, is_symmetric, first, end, all->values, entries).data(), count,
                 k);
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
    OwnRows own;
    if (!has_memory_for([&] { matrix.columns.list(own.starts, own.rows, own.values); })) {
      // The first process waits for them.
      abort_alone(rank_, "there is too little memory for a matrix that goes to the first process",
                  "use more memory");
    }
    send(own.starts.data(), own.starts.size(), 0, work_);
    send(own.rows.data(), own.rows.size(), 0, work_);
    send(own.values.data(), own.values.size(), 0, work_);
    return;
  }
  std::vector<OwnRows> parts(static_cast<std::size_t>(count_));
  for (int k = 1; k < count_; ++k) {
    OwnRows& part = parts[static_cast<std::size_t>(k)];
    part.starts.resize(static_cast<std::size_t>(matrix.counts[k]) + 1);
    receive(part.starts.data(), part.starts.size(), k, work_);
    const auto entries = static_cast<std::size_t>(part.starts.back());
    part.rows.resize(entries);
    part.values.resize(entries);
    receive(part.rows.data(), entries, k, work_);
    receive(part.values.data(), entries, k, work_);
    const int* list = matrix.lists.data() + matrix.list_first[k];
    for (int& row : part.rows) row = list[row];
    count_messages(3, 0);
    traffic_.bytes += static_cast<double>(sizeof(int) * part.starts.size() +
                                          entries * (sizeof(int) + sizeof(double)));
  }
  put_triangles_together(matrix, parts, starts, rows, values);
}

/// Entries above the diagonal of a column are those of columns before it, so that they are in their
/// places when its own are put behind them.
void Ranks::put_triangles_together(const Divided& matrix, const std::vector<OwnRows>& parts,
                                   int* starts, int* rows, double* values) {
  const auto visit = [&](auto&& add) {
    for (int k = 1; k < count_; ++k) {
      const OwnRows& part = parts[static_cast<std::size_t>(k)];
      for (int c = 0; c < matrix.counts[k]; ++c) {
        const int column = matrix.first[k] + c;
        for (int e = part.starts[c]; e < part.starts[c + 1]; ++e) {
          add(column, part.rows[e], part.values[e]);
          if (part.rows[e] != column) add(part.rows[e], column, part.values[e]);
        }
      }
    }
  };
  std::fill_n(starts, matrix.size + 1, 0);
  visit([&](int column, int, double) { ++starts[column + 1]; });
  std::partial_sum(starts, starts + matrix.size + 1, starts);
  std::vector<int> next(starts, starts + matrix.size);
  visit([&](int column, int row, double value) {
    rows[next[column]] = row;
    values[next[column]++] = value;
  });
}

void Ranks::forget(int matrix) {
  give(Task::forget, matrix);
  shared_->forget(matrix);
}

}  // namespace buckens_petsc
