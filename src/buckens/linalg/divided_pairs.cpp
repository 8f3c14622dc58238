// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/divided_pairs.h"

#include <array>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/put_off_work.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"

namespace buckens::linalg {

using Eigen::VectorXf;

DividedPairs::DividedPairs(Eigen::Index rows, int most, SharedRowOrder order)
    : rows_(rows), order_(std::move(order)) {
  std::array<char, 400> error{};
  const BuckensGridRows of = rows_for_plugin(order_);
  const std::scoped_lock lock(turn_of_grid_solver());
  number_ = grid_solver().make_pairs(static_cast<int>(rows), &of, most, error.data(),
                                     static_cast<int>(error.size()));
  if (number_ >= 0) return;
  throw NumericalError(
      fmt::format("kept solves of {} equations on {} processes: {}; use more memory, or fewer "
                  "kept-solves",
                  rows, Ranks::count(), error.data()));
}

DividedPairs::~DividedPairs() {
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish_at_end();
  grid_solver().forget(number_);
}

double DividedPairs::project(int pairs, Vector& r, Vector& along, TaskPool* /*pool*/) {
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish();
  double square = 0;
  if (!order_) {
    square = grid_solver().project(number_, pairs, r.data(), along.data());
  } else {
    std::vector<double> of_rows = order_->by_rows(r.data());
    square = grid_solver().project(number_, pairs, of_rows.data(), along.data());
    order_->by_variables(of_rows, r.data());
  }
  return std::sqrt(square);
}

void DividedPairs::combine(int pairs, const Vector& weights, const VectorXf& scale, bool adds,
                           Vector& x, TaskPool* /*pool*/) const {
  Vector sum(rows_);
  {
    const std::scoped_lock lock(turn_of_grid_solver());
    PutOffWork::finish();
    fill_by_rows(order_, sum.data(), [&](double* of_rows) {
      grid_solver().combine(number_, pairs, weights.data(), of_rows);
    });
  }
  if (!adds) x.setZero(rows_);
  x += sum.cwiseProduct(scale.cast<double>());
}

void DividedPairs::separate(int pair, Vector& load, Vector& answer, TaskPool* /*pool*/) {
  VectorXf c, x;
  take(pair, c, x);
  const double along = c.cast<double>().dot(load);
  load -= along * c.cast<double>();
  load = load.cast<float>().cast<double>().eval();
  answer -= along * x.cast<double>();
}

void DividedPairs::put(int pair, double scale, const Vector& load, const Vector& answer,
                       TaskPool* /*pool*/) {
  restore(pair, (scale * load).cast<float>(), (scale * answer).cast<float>());
}

void DividedPairs::restore(int pair, const VectorXf& load, const VectorXf& answer) {
  std::vector<float> c_rows, x_rows;
  if (order_) {
    c_rows = order_->by_rows(load.data());
    x_rows = order_->by_rows(answer.data());
  }
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish();
  grid_solver().put_pair(number_, pair, order_ ? c_rows.data() : load.data(),
                         order_ ? x_rows.data() : answer.data());
}

void DividedPairs::take(int pair, VectorXf& load, VectorXf& answer) const {
  load.resize(rows_);
  answer.resize(rows_);
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish();
  fill_by_rows(order_, load.data(), [&](float* c) {
    fill_by_rows(order_, answer.data(),
                 [&](float* x) { grid_solver().take_pair(number_, pair, c, x); });
  });
}

}  // namespace buckens::linalg
