// SPDX-License-Identifier: Apache-2.0
// The graph of a sum of divided matrices, of which no process has the whole pattern.
#include <algorithm>
#include <cstdint>

#include "ranks_messages.h"
#include "ranks_parts.h"
#include "ranks_terms.h"

namespace buckens_petsc {

namespace {

/// What a row adds to the mark of a column.
unsigned long long mark_of(int row) {
  std::uint64_t x = static_cast<std::uint64_t>(row) + 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return (x ^ (x >> 31U)) + 1;
}

/// Calls visit(column, row) for the entries here of the lower triangle of a sum.
template <class Matrix, class Visitor>
void visit_pattern(const std::vector<const Matrix*>& terms, int first, Visitor&& visit) {
  for (int k = 0; k < terms.front()->columns.count(); ++k) {
    visit_column(terms, k, first + k, [&](int row, const TermValues&) { visit(first + k, row); });
  }
}

}  // namespace

bool Ranks::marks(int count, const int* terms, unsigned long long* marks) {
  Order order;
  order.task = Task::marks;
  order.set_matrices(terms, count);
  give(order);
  return marks_together(order, marks);
}

bool Ranks::marks_together(const Order& order, unsigned long long* marks) {
  const std::vector<const Divided*> terms = terms_of(order);
  std::vector<unsigned long long> own;
  const bool is_found = has_memory_for([&] {
    own.assign(static_cast<std::size_t>(terms.front()->size), 0);
    visit_pattern(terms, terms.front()->first[rank_], [&own](int column, int row) {
      own[column] += mark_of(row);
      if (row != column) own[row] += mark_of(column);
    });
  });
  if (has_failed_somewhere(!is_found)) return false;
  MPI_Reduce(own.data(), marks, terms.front()->size, MPI_UNSIGNED_LONG_LONG, MPI_SUM, 0, work_);
  count_messages(count_ - 1, sizeof(own[0]) * static_cast<double>(own.size()));
  return true;
}

const std::vector<int>* Ranks::edges(int count, const int* terms, const int* vertex) {
  Order order;
  order.task = Task::edges;
  order.set_matrices(terms, count);
  give(order);
  return edges_together(order, vertex) ? &shared_->edges : nullptr;
}

void Ranks::forget_edges() { std::vector<int>().swap(shared_->edges); }

bool Ranks::edges_together(const Order& order, const int* vertex) {
  const std::vector<const Divided*> terms = terms_of(order);
  const int size = terms.front()->size;
  std::vector<int> of(static_cast<std::size_t>(size));
  if (vertex != nullptr) of.assign(vertex, vertex + size);
  MPI_Bcast(of.data(), size, MPI_INT, 0, work_);
  std::vector<int> own;
  const bool is_found = has_memory_for([&] {
    std::vector<int> seen_from(static_cast<std::size_t>(size), -1);  // by vertex
    visit_pattern(terms, terms.front()->first[rank_], [&](int column, int row) {
      const int a = of[column];
      const int b = of[row];
      // Columns of a vertex mostly follow each other.
      if (a == b || seen_from[b] == a) return;
      seen_from[b] = a;
      own.insert(own.end(), {a, b});
    });
  });
  if (has_failed_somewhere(!is_found)) return false;
  const int here = static_cast<int>(own.size());
  std::vector<int> counts(static_cast<std::size_t>(count_));
  MPI_Gather(&here, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, work_);
  const std::vector<int> first = starts_of(counts);
  if (rank_ == 0) shared_->edges.resize(static_cast<std::size_t>(first.back()));
  MPI_Gatherv(own.data(), here, MPI_INT, shared_->edges.data(), counts.data(), first.data(),
              MPI_INT, 0, work_);
  count_messages(3 * (count_ - 1), 0);
  traffic_.bytes += sizeof(int) * (static_cast<double>(count_ - 1) * (size + 1.0) +
                                   static_cast<double>(first.back()));
  return true;
}

}  // namespace buckens_petsc
