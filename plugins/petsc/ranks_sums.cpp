// SPDX-License-Identifier: Apache-2.0
// Sums of matrices that the other processes have.
#include <vector>

#include "ranks_messages.h"
#include "ranks_parts.h"
#include "ranks_terms.h"

namespace buckens_petsc {

std::vector<const Ranks::Divided*> Ranks::terms_of(const Order& order) const {
  std::vector<const Divided*> out;
  for (int k = 0; k < order.num_matrices(); ++k) {
    out.push_back(shared_->matrices.at(order.of[static_cast<std::size_t>(k)]).get());
  }
  return out;
}

/// Each process forms its columns of the lower triangle of a sum of divided matrices.
bool Ranks::sum_terms(const Order& order, const double* of_terms, OwnRows& own) {
  const std::vector<const Divided*> terms = terms_of(order);
  std::vector<double> weights(terms.size());
  if (of_terms != nullptr) weights.assign(of_terms, of_terms + terms.size());
  MPI_Bcast(weights.data(), static_cast<int>(weights.size()), MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, sizeof(double) * static_cast<double>(weights.size()));
  const int first = terms.front()->first[rank_];
  const int count = terms.front()->counts[rank_];
  return has_memory_for([&] {
    const auto visit = [&](int column, auto&& visitor) {
      visit_column(terms, column, first + column, visitor);
    };
    own.starts.assign(static_cast<std::size_t>(count) + 1, 0);
    for (int column = 0; column < count; ++column) {
      int& end = own.starts[static_cast<std::size_t>(column) + 1];
      end = own.starts[static_cast<std::size_t>(column)];
      visit(column, [&end](int, const TermValues&) { ++end; });
    }
    own.rows.reserve(static_cast<std::size_t>(own.starts.back()));
    own.values.reserve(own.rows.capacity());
    for (int column = 0; column < count; ++column) {
      visit(column, [&](int row, const TermValues& values) {
        own.rows.push_back(row);
        own.values.push_back(weighted(values, weights));
      });
    }
    own.columns = {own.starts.data(), own.rows.data(), own.values.data()};
  });
}

int Ranks::add_up(int count, const int* terms, const double* weights, const BuckensGridRows& rows,
                  BuckensGridFacts& facts) {
  Order order;
  order.task = Task::add_up;
  order.number = next_++;
  order.size = shared_->matrices.at(terms[0])->size;
  order.gives_rows = rows.first != nullptr ? 1 : 0;
  order.set_matrices(terms, count);
  give(order);
  return add_up_together(order, weights, &rows, facts) ? order.number : -1;
}

bool Ranks::add_up_together(const Order& order, const double* weights, const BuckensGridRows* of,
                            BuckensGridFacts& facts) {
  std::unique_ptr<Divided> matrix = empty_division(order, of);
  OwnRows own;
  if (has_failed_somewhere(!sum_terms(order, weights, own))) return false;
  return keep(order, of, std::move(matrix), own, facts);
}

double Ranks::inner_product(int count, const int* terms, const double* a, const double* b) {
  Order order;
  order.task = Task::inner_product;
  order.set_matrices(terms, count);
  give(order);
  return inner_product_together(order, a, b);
}

/// Entries below the diagonal are there for two.
double Ranks::inner_product_together(const Order& order, const double* a, const double* b) {
  const std::vector<const Divided*> terms = terms_of(order);
  std::vector<double> of_a(terms.size()), of_b(terms.size());
  if (a != nullptr) of_a.assign(a, a + terms.size());
  if (b != nullptr) of_b.assign(b, b + terms.size());
  MPI_Bcast(of_a.data(), static_cast<int>(of_a.size()), MPI_DOUBLE, 0, work_);
  MPI_Bcast(of_b.data(), static_cast<int>(of_b.size()), MPI_DOUBLE, 0, work_);
  const int first = terms.front()->first[rank_];
  double sum = 0;
  for (int k = 0; k < terms.front()->columns.count(); ++k) {
    double of_column = 0;
    visit_column(terms, k, first + k, [&](int row, const TermValues& values) {
      const double product = weighted(values, of_a) * weighted(values, of_b);
      of_column += row == first + k ? product : 2 * product;
    });
    sum += of_column;
  }
  std::vector<double> all(static_cast<std::size_t>(count_));
  MPI_Gather(&sum, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, 0, work_);
  count_messages(3 * (count_ - 1), 0);
  traffic_.bytes += sizeof(double) * (count_ - 1) * static_cast<double>(2 * terms.size() + 1);
  double total = 0;  // in the order of the processes
  for (const double share : all) total += share;
  return total;
}

}  // namespace buckens_petsc
