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
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_worker.h"
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

DividedVectors::DividedVectors(const Tables& tables)
    : size_(3 * tables.Ms->cols()), num_rows_(static_cast<int>(tables.N->rows())) {
  std::vector<int> first_nodes(static_cast<std::size_t>(Ranks::count()));
  const std::scoped_lock lock(turn_of_grid_solver());
  grid_solver().runs(static_cast<int>(size_), first_nodes.data());
  for (int& first : first_nodes) first /= 3;
  const DescribeColumns describe = [&](int first, int /*end*/) {
    const auto found = std::find(first_nodes.begin(), first_nodes.end(), first / 3);
    base::BytesTo put;
    describe_rows(*tables.Ms, *tables.positions, *tables.first_moments, *tables.N, first_nodes,
                  static_cast<std::size_t>(found - first_nodes.begin()), put);
    return put.take();
  };
  ColumnDescriptions descriptions(describe);
  const BuckensGridDescription of = descriptions.for_plugin();
  ErrorText error{};
  number_ = grid_solver().begin_rows(static_cast<int>(size_), &of, error.data(), size_of(error));
  if (number_ < 0) fail("vectors", size_, error);
}

DividedVectors::~DividedVectors() {
  const std::scoped_lock lock(turn_of_grid_solver());
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
  const std::scoped_lock lock(turn_of_grid_solver());
  if (grid_solver().put_rows(number_, out.number(), x.data(), error.data(), size_of(error)) != 0) {
    fail("a vector", size_, error);
  }
  return out;
}

void DividedVectors::catch_up() const {
  if (!pending_.empty()) work(0, nullptr);
}

void DividedVectors::work(std::size_t sums_each, double* sums) const {
  base::BytesTo put;
  put(number_);
  put.all(pending_.data(), pending_.size());
  pending_.clear();
  ErrorText error{};
  const auto bytes = put.bytes();
  const int failure =
      grid_solver().work_rows(bytes.data(), static_cast<long>(bytes.size()),
                              static_cast<int>(sums_each), sums, error.data(), size_of(error));
  if (failure != 0) fail("a step", size_, error);
}

void DividedVectors::take(const DividedVector& x, Vector& out) const {
  out.resize(size_);
  const std::scoped_lock lock(turn_of_grid_solver());
  catch_up();
  grid_solver().take_rows(number_, x.number(), out.data());
}

DividedVector DividedVectors::solve(void* factor, const DividedVector& b) {
  DividedVector x = new_vector();
  ErrorText error{};
  const std::scoped_lock lock(turn_of_grid_solver());
  catch_up();
  const SingleThread single;
  const int failure = grid_solver().solve_rows(factor, number_, b.number(), x.number(),
                                               error.data(), size_of(error));
  if (failure != 0) fail("a solve", size_, error);
  return x;
}

RowProgram::RowProgram(DividedVectors& of) : of_(&of) {}

RowProgram::Sums RowProgram::expect(std::size_t count) {
  const Sums out{expected_, count};
  expected_ += count;
  return out;
}

void RowProgram::put_terms(Terms terms) {
  const auto counts = [](const auto& term) { return term.first != 0.0; };
  put_(static_cast<int>(std::count_if(terms.begin(), terms.end(), counts)));
  for (const auto& term : terms) {
    if (!counts(term)) continue;
    put_(term.first);
    put_(term.second->number());
  }
}

DividedVector RowProgram::combine(Terms terms) {
  DividedVector out = of_->new_vector();
  put_(RowTask::combine);
  put_(out.number());
  put_(false);
  put_terms(terms);
  return out;
}

void RowProgram::add(const DividedVector& y, Terms terms) {
  put_(RowTask::combine);
  put_(y.number());
  put_(true);
  put_terms(terms);
}

DividedVector RowProgram::multiply_mass(const DividedVector& x) {
  DividedVector out = of_->new_vector();
  put_(RowTask::multiply_mass);
  put_(out.number());
  put_(x.number());
  return out;
}

RowProgram::Coupled RowProgram::couple(const DividedVector& d, const DividedVector& rate,
                                       const DividedVector& acceleration, const double* weights) {
  Coupled out;
  if (weights != nullptr) out.load = of_->new_vector();
  put_(RowTask::couple);
  put_(out.load.empty() ? -1 : out.load.number());
  for (const DividedVector* x : {&d, &rate, &acceleration}) put_(x->number());
  const std::array<double, kCoupleWeights> none{};
  put_.all(weights != nullptr ? weights : none.data(), none.size());
  out.sums = expect(kCoupleSums);
  return out;
}

RowProgram::Sums RowProgram::moments(const DividedVector& x) {
  put_(RowTask::moments);
  put_(x.number());
  return expect(kMomentSums);
}

void RowProgram::subtract(const DividedVector& y, const double* motion) {
  put_(RowTask::subtract);
  put_(y.number());
  put_.all(motion, kMotionNumbers);
}

RowProgram::Sums RowProgram::row_products(std::initializer_list<const DividedVector*> vectors) {
  put_(RowTask::row_products);
  put_(static_cast<int>(vectors.size()));
  for (const DividedVector* x : vectors) put_(x->number());
  return expect(vectors.size() * static_cast<std::size_t>(of_->num_rows_));
}

RowProgram::Sums RowProgram::compare(const DividedVector& x, const DividedVector& before,
                                     const DividedVector& weights) {
  put_(RowTask::compare);
  for (const DividedVector* each : {&x, &before, &weights}) put_(each->number());
  return expect(kCompared);
}

RowProgram::Sums RowProgram::total(std::initializer_list<const DividedVector*> vectors) {
  put_(RowTask::total);
  put_(static_cast<int>(vectors.size()));
  for (const DividedVector* x : vectors) put_(x->number());
  return expect(1);
}

void RowProgram::run() {
  const std::scoped_lock lock(turn_of_grid_solver());
  std::vector<int> dropped;
  dropped.swap(*of_->dropped_);
  for (const int number : dropped) {
    put_(RowTask::drop);
    put_(number);
  }
  const auto own = put_.bytes();
  of_->pending_.insert(of_->pending_.end(), own.begin(), own.end());
  if (expected_ == 0) return;
  replies_.assign(expected_ * static_cast<std::size_t>(Ranks::count() - 1), 0.0);
  of_->work(expected_, replies_.data());
}

Vector RowProgram::sum(const Sums& of) const {
  Vector out = Vector::Zero(static_cast<Eigen::Index>(of.count));
  if (of.count == 0) return out;
  for (std::size_t first = of.first; first + of.count <= replies_.size(); first += expected_) {
    out += Eigen::Map<const Vector>(replies_.data() + first, out.size());
  }
  return out;
}

double RowProgram::most(const Sums& of, std::size_t index) const {
  double out = 0;
  for (std::size_t at = of.first + index; at < replies_.size(); at += expected_) {
    out = std::max(out, replies_[at]);
  }
  return out;
}

}  // namespace buckens::linalg
