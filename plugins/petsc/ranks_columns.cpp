// SPDX-License-Identifier: Apache-2.0
// Matrices of which each process makes its columns, and what the first one knows of them.
#include <algorithm>
#include <array>
#include <numeric>

#include "process_memory.h"
#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {
// Those of some thousand elements.
constexpr int kRowsAtATime = 12'288;
}  // namespace

int Ranks::make_columns(int size, const BuckensGridRows& rows, const BuckensGridDescription& of,
                        BuckensGridFacts& facts) {
  const Order order = give_new(Task::make_columns, size, 0, &rows);
  return make_columns_together(order, &rows, &of, facts) ? order.number : -1;
}

int Ranks::make_rows(int rows, int columns, const BuckensGridRows& runs,
                     const BuckensGridDescription& of) {
  const Order order = give_new(Task::make_rows, rows, columns, &runs);
  BuckensGridFacts facts{};
  return make_columns_together(order, &runs, &of, facts) ? order.number : -1;
}

/// A process makes its columns while the first describes those of the next.
bool Ranks::make_columns_together(const Order& order, const BuckensGridRows* rows,
                                  const BuckensGridDescription* of, BuckensGridFacts& facts) {
  std::unique_ptr<Divided> matrix = empty_division(order, rows);
  OwnRows made;
  bool is_made = false;
  if (of != nullptr) {
    is_made = send_descriptions(matrix->first, *of);
  } else {
    std::vector<char> description;
    is_made = receive_description(description) &&
              (matrix->is_symmetric ? make_columns_of(description, *matrix, made)
                                    : make_rows_of(description, order.columns, *matrix));
  }
  if (has_failed_somewhere(!is_made)) return false;
  bool is_kept = true;
  if (matrix->is_symmetric) {
    is_kept = keep(order, rows, std::move(matrix), made, facts);
  } else {
    exchange_lists(*matrix);
    shared_->matrices[order.number] = std::move(matrix);
  }
  give_memory_back();  // of elements and of what they add
  return is_kept;
}

/// Of the others: what send_descriptions() sends.
bool Ranks::receive_description(std::vector<char>& description) {
  long bytes = 0;
  receive(&bytes, 1, 0, work_);
  if (bytes < 0) return false;
  description.resize(static_cast<std::size_t>(bytes));
  receive(description.data(), description.size(), 0, work_);
  return true;
}

bool Ranks::send_descriptions(const std::vector<int>& first, const BuckensGridDescription& of) {
  bool has_memory = true;
  for (int k = 1; k < count_; ++k) {
    const void* bytes = nullptr;
    long count = -1;
    has_memory = has_memory && of.describe(of.source, first[k], first[k + 1], &bytes, &count) == 0;
    if (!has_memory) count = -1;
    send_counted(&count, 1, k);
    if (count < 0) continue;
    send_counted(static_cast<const char*>(bytes), static_cast<std::size_t>(count), k);
  }
  if (!has_memory) set_reason("there is too little memory for what the rows are made of");
  return has_memory;
}

/// Calls visit(columns) for those that the program makes.
template <class Visitor>
bool Ranks::make_some(const std::vector<char>& description, int first, int end, Visitor&& visit) {
  std::array<char, 400> error{};
  BuckensGridColumns columns{};
  const auto bytes = static_cast<long>(description.size());
  if (maker_.make(description.data(), bytes, first, end, &columns, error.data(),
                  static_cast<int>(error.size())) != 0) {
    set_reason(error.data());
    return false;
  }
  const bool has_room = has_memory_for([&] { visit(columns); });
  (void)maker_.make(nullptr, 0, 0, 0, nullptr, error.data(), static_cast<int>(error.size()));
  return has_room;
}

bool Ranks::make_columns_of(const std::vector<char>& description, const Divided& matrix,
                            OwnRows& made) {
  const int first = matrix.first[rank_];
  const int end = matrix.first[rank_ + 1];
  return make_some(description, first, end, [&](const BuckensGridColumns& columns) {
    const int entries = columns.starts[end - first];
    made.starts.assign(columns.starts, columns.starts + (end - first) + 1);
    made.rows.assign(columns.rows, columns.rows + entries);
    made.values.assign(columns.values, columns.values + entries);
  });
}

/// Some rows at a time, since making takes as much memory as keeping. A first time tells which
/// variables there are.
bool Ranks::make_rows_of(const std::vector<char>& description, int columns, Divided& matrix) {
  const int end = matrix.first[rank_ + 1];
  const auto visit_some = [&](auto&& visit) {
    for (int row = matrix.first[rank_]; row < end; row += kRowsAtATime) {
      const int count = std::min(kRowsAtATime, end - row);
      if (!make_some(description, row, row + count,
                     [&](const BuckensGridColumns& made) { visit(made, count); })) {
        return false;
      }
    }
    return true;
  };
  std::vector<int> place, places_of_row;
  if (!has_memory_for([&] { place.assign(static_cast<std::size_t>(columns), -1); })) return false;
  std::size_t entries = 0;
  if (!visit_some([&](const BuckensGridColumns& made, int count) {
        for (int e = 0; e < made.starts[count]; ++e) place[made.rows[e]] = 0;
        entries += static_cast<std::size_t>(made.starts[count]);
      })) {
    return false;
  }
  const bool has_room = has_memory_for([&] {
    for (int variable = 0; variable < columns; ++variable) {
      if (place[variable] < 0) continue;
      place[variable] = static_cast<int>(matrix.variables.size());
      matrix.variables.push_back(variable);
    }
    matrix.columns.reserve(static_cast<std::size_t>(matrix.counts[rank_]), entries);
  });
  if (!has_room) return false;
  return visit_some([&](const BuckensGridColumns& made, int count) {
    for (int row = 0; row < count; ++row) {
      const int first = made.starts[row];
      places_of_row.clear();
      for (int e = first; e < made.starts[row + 1]; ++e) {
        places_of_row.push_back(place[made.rows[e]]);
      }
      matrix.columns.add(places_of_row.data(), made.values + first,
                         static_cast<int>(places_of_row.size()));
    }
  });
}

void Ranks::sum_facts(const OwnRows& columns, const std::vector<int>& variables,
                      BuckensGridFacts& facts) {
  BuckensGridFacts own{};
  const int count = static_cast<int>(columns.starts.size()) - 1;
  for (int k = 0; k < count; ++k) {
    double squares = 0;
    for (int e = columns.starts[k]; e < columns.starts[k + 1]; ++e) {
      const int times = columns.rows[e] == k ? 1 : 2;
      own.entries += times;
      squares += times * columns.values[e] * columns.values[e];
    }
    own.square_norm += squares;
  }
  if (rank_ != 0) {
    const BuckensGridColumns entries{columns.starts.data(), columns.rows.data(),
                                     columns.values.data()};
    maker_.add_content(count, &entries, variables.data(), own.content);
  }
  std::vector<BuckensGridFacts> all(static_cast<std::size_t>(count_));
  MPI_Gather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, 0, work_);
  count_messages(count_ - 1, sizeof own);
  facts = {};
  for (const BuckensGridFacts& share : all) {  // in the order of the processes
    facts.entries += share.entries;
    facts.square_norm += share.square_norm;
    for (int k = 0; k < 2; ++k) facts.content[k] += share.content[k];
  }
}

void Ranks::diagonal(int matrix, double* values) {
  give(Task::diagonal, matrix);
  Order order;
  order.number = matrix;
  diagonal_together(order, values);
}

void Ranks::diagonal_together(const Order& order, double* values) {
  const Divided& matrix = *shared_->matrices.at(order.number);
  const int count = matrix.columns.count();
  std::vector<double> own(static_cast<std::size_t>(count), 0.0);
  for (int k = 0; k < count; ++k) {
    const KeptColumns::Column of = matrix.columns.column(k);
    // Variables begin with the columns here.
    if (of.size > 0 && of.row(0) == k) own[static_cast<std::size_t>(k)] = of.value(0);
  }
  MPI_Gatherv(own.data(), count, MPI_DOUBLE, values, matrix.counts.data(), matrix.first.data(),
              MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(double) * static_cast<double>(matrix.size);
}

void Ranks::near_diagonal(int matrix, const int* lengths, double* values) {
  Order order;
  order.task = Task::near_diagonal;
  order.number = matrix;
  give(order);
  near_diagonal_together(order, lengths, values);
}

void Ranks::near_diagonal_together(const Order& order, const int* lengths, double* values) {
  const Divided& matrix = *shared_->matrices.at(order.number);
  const int columns = matrix.columns.count();
  std::vector<int> own(static_cast<std::size_t>(columns));
  MPI_Scatterv(lengths, matrix.counts.data(), matrix.first.data(), MPI_INT, own.data(), columns,
               MPI_INT, 0, work_);
  std::vector<double> found(std::accumulate(own.begin(), own.end(), std::size_t{0}), 0.0);
  double* of_column = found.data();
  for (int k = 0; k < columns; ++k) {
    const KeptColumns::Column of = matrix.columns.column(k);
    for (int e = 0; e < of.size; ++e) {
      const int below = matrix.variables[of.row(e)] - matrix.variables[k];
      if (below >= own[k]) break;
      of_column[below] = of.value(e);
    }
    of_column += own[k];
  }
  std::vector<int> counts(static_cast<std::size_t>(count_), 0);
  for (int k = 0; k < count_ && lengths != nullptr; ++k) {
    counts[k] = std::accumulate(lengths + matrix.first[k], lengths + matrix.first[k + 1], 0);
  }
  const std::vector<int> first = starts_of(counts);
  MPI_Gatherv(found.data(), static_cast<int>(found.size()), MPI_DOUBLE, values, counts.data(),
              first.data(), MPI_DOUBLE, 0, work_);
  count_messages(2 * (count_ - 1), 0);
  traffic_.bytes += sizeof(int) * static_cast<double>(matrix.size) + sizeof(double) * first.back();
}

}  // namespace buckens_petsc
