// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/divided_vectors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <mutex>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/column_descriptions.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/put_off_work.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/single_thread.h"

namespace buckens::linalg {

namespace {

using ErrorText = std::array<char, 400>;

int size_of(const ErrorText& text) { return static_cast<int>(text.size()); }

[[noreturn]] void fail(const char* what, Eigen::Index size, const ErrorText& why) {
  throw NumericalError(
      fmt::format("{} of {} variables on {} processes failed: {}; use more memory, "
                  "or run it in one process",
                  what, size, Ranks::count(), why.data()));
}

/// Several threads may work on different bodies. Begins anew when numbers run out.
int next_vector() {
  constexpr unsigned kLargest = std::numeric_limits<int>::max();
  static std::atomic<unsigned> number = 0;
  return static_cast<int>(number++ & kLargest);
}

}  // namespace

DividedVectors::DividedVectors(const WholeNodes& of, const RowMajorMatrix& N)
    : size_(N.cols()), num_rows_(static_cast<int>(N.rows())), order_(of.order) {
  begin(of, N, 3);
}

DividedVectors::DividedVectors(const WholeVariables& of, const RowMajorMatrix& N)
    : size_(N.cols()), num_rows_(static_cast<int>(N.rows())), order_(of.order) {
  begin(of, N, 1);
}

/// @param width variables of a unit
template <class Whole>
void DividedVectors::begin(const Whole& of, const RowMajorMatrix& N, int width) {
  std::vector<int> first_units(static_cast<std::size_t>(Ranks::count()));
  const std::scoped_lock lock(turn_of_grid_solver());
  if (order_) {
    first_units = order_->first_rows();
  } else {
    grid_solver().runs(static_cast<int>(size_), first_units.data());
  }
  for (int& first : first_units) first /= width;
  const DescribeColumns describe = [&](int first, int /*end*/) {
    const auto found = std::find(first_units.begin(), first_units.end(), first / width);
    base::BytesTo put;
    describe_rows(of, N, first_units, static_cast<std::size_t>(found - first_units.begin()), put);
    return put.take();
  };
  ColumnDescriptions descriptions(describe);
  const BuckensGridDescription whole = descriptions.for_plugin();
  ErrorText error{};
  const BuckensGridRows rows = rows_for_plugin(order_);
  number_ = grid_solver().begin_rows(static_cast<int>(size_), &rows, &whole, error.data(),
                                     size_of(error));
  if (number_ < 0) fail("vectors", size_, error);
}

DividedVectors::~DividedVectors() {
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish_at_end();
  grid_solver().forget(number_);
}

DividedVector DividedVectors::new_vector() {
  DividedVector out;
  out.held_ = std::make_shared<DividedVector::Held>(dropped_, next_vector());
  return out;
}

DividedVector DividedVectors::put(const Vector& x) {
  DividedVector out = new_vector();
  ErrorText error{};
  std::vector<double> by_rows;
  if (order_) by_rows = order_->by_rows(x.data());
  const double* values = order_ ? by_rows.data() : x.data();
  const std::scoped_lock lock(turn_of_grid_solver());
  if (grid_solver().put_rows(number_, out.number(), values, error.data(), size_of(error)) != 0) {
    fail("a vector", size_, error);
  }
  return out;
}

void DividedVectors::take(const DividedVector& x, Vector& out) const {
  out.resize(size_);
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish();
  fill_by_rows(order_, out.data(),
               [&](double* values) { grid_solver().take_rows(number_, x.number(), values); });
}

DividedVector DividedVectors::solve(void* factor, const DividedVector& b) {
  DividedVector x = new_vector();
  ErrorText error{};
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish();
  const SingleThread single;
  const int failure = grid_solver().solve_rows(factor, number_, b.number(), x.number(),
                                               error.data(), size_of(error));
  if (failure != 0) fail("a solve", size_, error);
  return x;
}

}  // namespace buckens::linalg
