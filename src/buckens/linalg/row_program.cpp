// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_program.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/put_off_work.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/sparse_rows.h"

namespace buckens::linalg {

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

DividedVector RowProgram::multiply(const DividedMatrix& A, const DividedVector& x) {
  DividedVector out = of_->new_vector();
  put_(RowTask::multiply);
  put_(out.number());
  put_(x.number());
  put_(A.number());
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

RowProgram::Sums RowProgram::resultants(const DividedVector& f) {
  put_(RowTask::resultants);
  put_(f.number());
  return expect(kMomentSums);
}

void RowProgram::subtract_load(const DividedVector& f, const double* motion) {
  put_(RowTask::subtract_load);
  put_(f.number());
  put_.all(motion, kMotionNumbers);
}

void RowProgram::add_row_loads(const DividedVector& f, const Eigen::Ref<const Vector>& weights) {
  put_(RowTask::add_row_loads);
  put_(f.number());
  Vector all = Vector::Zero(of_->num_rows());
  all.head(weights.size()) = weights;
  put_.all(all.data(), static_cast<std::size_t>(all.size()));
}

RowProgram::Sums RowProgram::row_products(std::span<const DividedVector* const> vectors) {
  put_(RowTask::row_products);
  put_(static_cast<int>(vectors.size()));
  for (const DividedVector* x : vectors) put_(x->number());
  return expect(vectors.size() * static_cast<std::size_t>(of_->num_rows_));
}

RowProgram::Sums RowProgram::pick(const DividedVector& x, std::span<const int> variables) {
  put_(RowTask::pick);
  put_(x.number());
  put_(static_cast<int>(variables.size()));
  for (const int variable : variables) put_(of_->order_ ? of_->order_->row(variable) : variable);
  return expect(variables.size());
}

RowProgram::Sums RowProgram::compare(const DividedVector& x, const DividedVector& before,
                                     const DividedVector& weights,
                                     const DividedVector& of_largest) {
  put_(RowTask::compare);
  for (const DividedVector* each : {&x, &before, &weights, &of_largest}) put_(each->number());
  return expect(kCompared);
}

RowProgram::Sums RowProgram::total(std::initializer_list<const DividedVector*> vectors) {
  put_(RowTask::total);
  put_(static_cast<int>(vectors.size()));
  for (const DividedVector* x : vectors) put_(x->number());
  return expect(1);
}

RowProgram::Sums RowProgram::square(const DividedVector& x) {
  put_(RowTask::square);
  put_(x.number());
  return expect(1);
}

RowProgram::Sums RowProgram::inner_product(const DividedVector& x, const DividedVector& y) {
  put_(RowTask::inner_product);
  put_(x.number());
  put_(y.number());
  return expect(1);
}

RowProgram::Sums RowProgram::largest_norm(const SparseRows& A, const DividedVector& x,
                                          const Matrix& F) {
  put_(RowTask::largest_norm);
  put_(x.number());
  const auto [number, is_new] = A.number_for(of_->number_);
  put_(number);
  put_(is_new);
  std::vector<int> rows;
  if (is_new && of_->order_) rows = of_->order_->rows();
  put_(static_cast<int>(rows.size()));
  put_.all(rows.data(), rows.size());
  put_(static_cast<int>(F.rows()));
  put_(static_cast<int>(F.cols()));
  put_.all(F.data(), static_cast<std::size_t>(F.size()));
  return expect(1);
}

DividedVector RowProgram::scale(const DividedVector& x, const DividedVector& weights,
                                bool divides) {
  DividedVector out = of_->new_vector();
  put_(RowTask::scale);
  put_(out.number());
  put_(x.number());
  put_(weights.number());
  put_(divides);
  return out;
}

void RowProgram::put_pairs(RowTask task, const Pairs& pairs) {
  put_(task);
  put_(pairs.number);
  put_(pairs.first);
  put_(pairs.count);
}

RowProgram::Sums RowProgram::pair_products(const Pairs& pairs, const DividedVector& r) {
  put_pairs(RowTask::pair_products, pairs);
  put_(r.number());
  return expect(static_cast<std::size_t>(pairs.count));
}

void RowProgram::subtract_loads(const Pairs& pairs, const DividedVector& r, const Vector& weights) {
  put_pairs(RowTask::subtract_loads, pairs);
  put_(r.number());
  put_.all(weights.data(), static_cast<std::size_t>(pairs.count));
}

DividedVector RowProgram::combine_answers(const Pairs& pairs, const Vector& weights) {
  DividedVector out = of_->new_vector();
  put_pairs(RowTask::combine_answers, pairs);
  put_(out.number());
  put_(false);
  put_.all(weights.data(), static_cast<std::size_t>(pairs.count));
  return out;
}

void RowProgram::add_answers(const Pairs& pairs, const DividedVector& y, const Vector& weights) {
  put_pairs(RowTask::combine_answers, pairs);
  put_(y.number());
  put_(true);
  put_.all(weights.data(), static_cast<std::size_t>(pairs.count));
}

void RowProgram::put_pair(const Pairs& pair, double factor, const DividedVector& load,
                          const DividedVector& answer) {
  put_pairs(RowTask::put_pair, pair);
  put_(factor);
  put_(load.number());
  put_(answer.number());
}

void RowProgram::run() {
  const std::scoped_lock lock(turn_of_grid_solver());
  std::vector<int> dropped;
  dropped.swap(*of_->dropped_);
  for (const int number : dropped) {
    put_(RowTask::drop);
    put_(number);
  }
  PutOffWork::add(of_->number_, put_.bytes());
  if (expected_ == 0) return;
  replies_.assign(expected_ * static_cast<std::size_t>(Ranks::count() - 1), 0.0);
  PutOffWork::finish_with_sums(expected_, replies_.data());
}

Vector RowProgram::sum(const Sums& of) const {
  Vector out = Vector::Zero(static_cast<Eigen::Index>(of.count));
  if (of.count == 0) return out;
  for (std::size_t first = of.first; first + of.count <= replies_.size(); first += expected_) {
    out += Eigen::Map<const Vector>(replies_.data() + first, out.size());
  }
  return out;
}

NodeSums node_sums(const Vector& sums) {
  NodeSums out;
  std::copy(sums.begin(), sums.end(), out.value);
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
