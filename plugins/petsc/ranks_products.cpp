// SPDX-License-Identifier: Apache-2.0
// Products with matrices that the first process has given away.
#include <algorithm>
#include <iterator>
#include <vector>

#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

void Ranks::multiply(int count, const int* matrices, const double* const* x, double* const* y) {
  Order order;
  order.task = Task::multiply;
  order.set_matrices(matrices, count);
  give(order);
  multiply_together(order, x, y);
}

/// One message to each process, with what its columns need of all x, and one back, with what they
/// add to all y.
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

/// Process after process, so that the first one never has more than what one of them needs or adds.
void Ranks::ask_for_products(const std::vector<const Divided*>& matrices, const double* const* x,
                             double* const* y) {
  std::vector<double>& share = shared_->share;
  for (int k = 1; k < count_; ++k) {
    share.clear();
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      const int* list = matrices[m]->lists.data() + matrices[m]->list_first[k];
      std::transform(list, list + matrices[m]->list_counts[k], std::back_inserter(share),
                     [from = x[m]](int variable) { return from[variable]; });
    }
    send_counted(share.data(), share.size(), k);
  }
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    if (matrices[m]->is_symmetric) std::fill_n(y[m], matrices[m]->size, 0.0);
  }
  for (int k = 1; k < count_; ++k) {
    std::size_t back = 0;
    for (const Divided* A : matrices) {
      back += static_cast<std::size_t>(A->is_symmetric ? A->list_counts[k] : A->counts[k]);
    }
    share.resize(back);
    receive(share.data(), back, k, work_);
    add_share(matrices, k, share.data(), y);
    count_messages(1, sizeof(double) * static_cast<double>(back));
  }
}

/// What a process adds to all y.
void Ranks::add_share(const std::vector<const Divided*>& matrices, int process, const double* from,
                      double* const* y) {
  const auto k = static_cast<std::size_t>(process);
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    const Divided& A = *matrices[m];
    if (A.is_symmetric) {
      const int* list = A.lists.data() + A.list_first[k];
      for (int i = 0; i < A.list_counts[k]; ++i) y[m][list[i]] += *from++;
    } else {
      std::copy_n(from, A.counts[k], y[m] + A.first[k]);
      from += A.counts[k];
    }
  }
}

/// y ← y + A x of the columns here of a symmetric matrix, and of their entries as rows.
void Ranks::Divided::add_symmetric(int count, const double* x, double* y) const {
  for (int column = 0; column < count; ++column) {
    const KeptColumns::Column of = columns.column(column);
    double sum = 0;
    for (int e = 0; e < of.size; ++e) {
      const int row = of.row(e);
      sum += of.value(e) * x[row];
      if (row != column) y[row] += of.value(e) * x[column];
    }
    y[column] += sum;
  }
}

void Ranks::Divided::add_rows(int count, const double* x, double* y) const {
  for (int row = 0; row < count; ++row) {
    const KeptColumns::Column of = columns.column(row);
    for (int e = 0; e < of.size; ++e) y[row] += of.value(e) * x[of.row(e)];
  }
}

void Ranks::form_products(const std::vector<const Divided*>& matrices) {
  std::size_t there = 0, back = 0;
  for (const Divided* A : matrices) {
    there += A->variables.size();
    back += A->num_results(rank_);
  }
  std::vector<double>& received = shared_->share;
  std::vector<double>& sent = shared_->results;
  received.resize(there);
  sent.assign(back, 0.0);
  receive(received.data(), there, 0, work_);
  const double* x = received.data();
  double* y = sent.data();
  for (const Divided* A : matrices) {
    if (A->is_symmetric) {
      A->add_symmetric(A->counts[rank_], x, y);
    } else {
      A->add_rows(A->counts[rank_], x, y);
    }
    x += A->variables.size();
    y += A->num_results(rank_);
  }
  send(sent.data(), back, 0, work_);
}

/// y = A x, each process its rows of both: entries of x come from others, and what its columns add
/// to their rows goes back.
void Ranks::multiply_among_others(int matrix, const double* x, double* y) {
  Divided& A = *shared_->matrices.at(matrix);
  const auto here = static_cast<std::size_t>(A.counts[rank_]);
  if (!A.way) {
    const std::vector<int> beside(A.variables.begin() + A.counts[rank_], A.variables.end());
    A.way = std::make_unique<Way>(beside, A.first.data() + 1, others_);
  }
  std::vector<double>& all = shared_->share;
  std::vector<double>& products = shared_->results;
  all.resize(A.variables.size());
  products.assign(A.variables.size(), 0.0);
  std::copy_n(x, here, all.begin());
  A.way->bring(x, all.data() + here);
  A.add_symmetric(A.counts[rank_], all.data(), products.data());
  std::copy_n(products.begin(), here, y);
  A.way->give_back(products.data() + here, y, true);
}

/// The rows of A x here go to `results`.
void Ranks::multiply_rows_among_others(Divided& A, const double* x) {
  std::vector<double>& all = shared_->share;
  all.resize(A.variables.size());
  A.way->bring(x, all.data());
  shared_->results.assign(static_cast<std::size_t>(A.counts[rank_]), 0.0);
  A.add_rows(A.counts[rank_], all.data(), shared_->results.data());
}

}  // namespace buckens_petsc
