// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/divided_matrix.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/put_off_work.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"

namespace buckens::linalg {

namespace {

std::vector<int> numbers_of(std::span<const DividedMatrix* const> terms) {
  std::vector<int> out;
  for (const DividedMatrix* term : terms) out.push_back(term->number());
  return out;
}

double gathered_bytes = 0;  // guarded by turn_of_grid_solver()
constexpr const char* kMoreMemory = "use more memory, or fewer processes on a machine";

}  // namespace

/// What is asked of the plug-in, and what helps where that fails.
struct DividedMatrix::Wish {
  const char *verb, *remedy;
};

/// @param ask (plug-in, rows, facts, error, its size) → number
template <class Ask>
void DividedMatrix::ask(Eigen::Index size, const Wish& wish, Ask&& ask) {
  std::array<char, 400> error{};
  const BuckensGridPlugin& plugin = grid_solver();
  const BuckensGridRows rows = rows_for_plugin(order_);
  diagonal_.resize(size);
  const std::scoped_lock lock(turn_of_grid_solver());
  number_ = ask(plugin, &rows, &facts_, error.data(), static_cast<int>(error.size()));
  if (number_ < 0) {
    throw NumericalError(
        fmt::format("a matrix of {} equations on {} processes could not be {}: {}; {}", size,
                    Ranks::count(), wish.verb, error.data(), wish.remedy));
  }
  fill_by_rows(order_, diagonal_.data(), [&](double* values) { plugin.diagonal(number_, values); });
}

DividedMatrix::DividedMatrix(const SparseMatrix& A, SharedRowOrder order)
    : order_(std::move(order)) {
  SparseMatrix by_rows;
  if (order_) by_rows = renumbered(A, order_->rows());
  const SparseMatrix& all = order_ ? by_rows : A;
  const BuckensGridColumns columns{all.outerIndexPtr(), all.innerIndexPtr(), all.valuePtr()};
  ask(A.cols(), {"divided", kMoreMemory},
      [&](const auto& plugin, const auto* rows, auto* facts, char* error, int error_size) {
        return plugin.divide(static_cast<int>(A.cols()), rows, &columns, facts, error, error_size);
      });
}

DividedMatrix::DividedMatrix(Eigen::Index size, const DescribeColumns& describe,
                             SharedRowOrder order)
    : order_(std::move(order)) {
  ColumnDescriptions own(describe);
  const BuckensGridDescription of = own.for_plugin();
  ask(size, {"made", "check the mesh, or use more memory"},
      [&](const auto& plugin, const auto* rows, auto* facts, char* error, int error_size) {
        return plugin.make_columns(static_cast<int>(size), rows, &of, facts, error, error_size);
      });
}

DividedMatrix::DividedMatrix(std::span<const DividedMatrix* const> terms,
                             std::span<const double> weights)
    : order_(terms.front()->row_order()) {
  const std::vector<int> numbers = numbers_of(terms);
  ask(terms.front()->size(), {"added up", kMoreMemory},
      [&](const auto& plugin, const auto* rows, auto* facts, char* error, int error_size) {
        return plugin.add_up(static_cast<int>(numbers.size()), numbers.data(), weights.data(), rows,
                             facts, error, error_size);
      });
}

DividedMatrix::~DividedMatrix() {
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish_at_end();
  grid_solver().forget(number_);
}

void DividedMatrix::multiply(std::span<const Product> products) {
  while (!products.empty()) {
    const auto some = products.first(std::min<std::size_t>(kBuckensMostProducts, products.size()));
    std::array<int, kBuckensMostProducts> numbers{};
    std::array<const double*, kBuckensMostProducts> x{};
    std::array<double*, kBuckensMostProducts> y{};
    std::array<std::vector<double>, kBuckensMostProducts> x_rows,
        y_rows;  // where there is an order
    for (std::size_t k = 0; k < some.size(); ++k) {
      numbers[k] = some[k].A->number_;
      x[k] = some[k].x;
      y[k] = some[k].y;
      const SharedRowOrder& order = some[k].A->order_;
      if (!order) continue;
      x_rows[k] = order->by_rows(some[k].x);
      y_rows[k].resize(x_rows[k].size());
      x[k] = x_rows[k].data();
      y[k] = y_rows[k].data();
    }
    {
      const std::scoped_lock lock(turn_of_grid_solver());
      grid_solver().multiply(static_cast<int>(some.size()), numbers.data(), x.data(), y.data());
    }
    for (std::size_t k = 0; k < some.size(); ++k) {
      if (some[k].A->order_) some[k].A->order_->by_variables(y_rows[k], some[k].y);
    }
    products = products.subspan(some.size());
  }
}

double DividedMatrix::inner_product(std::span<const DividedMatrix* const> terms,
                                    std::span<const double> a, std::span<const double> b) {
  const std::vector<int> numbers = numbers_of(terms);
  const std::scoped_lock lock(turn_of_grid_solver());
  return grid_solver().inner_product(static_cast<int>(numbers.size()), numbers.data(), a.data(),
                                     b.data());
}

double DividedMatrix::bytes_gathered() {
  const std::scoped_lock lock(turn_of_grid_solver());
  return gathered_bytes;
}

SparseMatrix DividedMatrix::gathered() const {
  SparseMatrix out(size(), size());
  out.resizeNonZeros(entries());
  {
    const std::scoped_lock lock(turn_of_grid_solver());
    gathered_bytes += static_cast<double>(entries()) * (sizeof(double) + sizeof(int)) +
                      static_cast<double>(size() + 1) * sizeof(int);
    grid_solver().gather(number_, out.outerIndexPtr(), out.innerIndexPtr(), out.valuePtr());
  }
  return order_ ? renumbered_symmetric(out, order_->variables()) : out;
}

Vector DividedMatrix::near_diagonal(std::span<const int> lengths) const {
  Vector out(std::accumulate(lengths.begin(), lengths.end(), Eigen::Index{0}));
  std::vector<int> of_rows(lengths.begin(), lengths.end());
  if (order_) of_rows = order_->by_rows(lengths.data());
  Vector found(out.size());
  {
    const std::scoped_lock lock(turn_of_grid_solver());
    grid_solver().near_diagonal(number_, of_rows.data(), found.data());
  }
  if (!order_) return found;
  std::vector<Eigen::Index> starts = {0};  // of the variables
  for (const int length : lengths) starts.push_back(starts.back() + length);
  Eigen::Index next = 0;
  for (const int variable : order_->variables()) {
    const Eigen::Index length = lengths[static_cast<std::size_t>(variable)];
    out.segment(starts[static_cast<std::size_t>(variable)], length) = found.segment(next, length);
    next += length;
  }
  return out;
}

double DividedMatrix::norm() const { return std::sqrt(facts_.square_norm); }

}  // namespace buckens::linalg
