// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_worker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace buckens::linalg {

namespace {

// Vectors come and go by the dozen in each step.
constexpr std::size_t kMostSpare = 16;

std::size_t place(int number) { return static_cast<std::size_t>(number); }

}  // namespace

void RowWorker::add(int space, RowTables tables) {
  auto made = std::make_unique<Space>();
  made->number = space;
  made->tables = std::move(tables);
  made->inertia = row_inertia(made->tables);
  spaces_[space] = std::move(made);
}

void RowWorker::remove(int space) {
  const Space* gone = spaces_.at(space).get();
  std::erase_if(vectors_, [gone](const auto& own) { return own.second.space == gone; });
  spaces_.erase(space);
  spare_.clear();
}

std::span<double> RowWorker::rows(int space, int vector) {
  const Space& of = *spaces_.at(space);
  return {make_room(of, vector), of.rows()};
}

double* RowWorker::make_room(const Space& space, int vector) {
  Held& own = vectors_[vector];
  own.space = &space;
  if (own.numbers.size() == space.room()) return own.numbers.data();
  const auto found = std::find_if(spare_.begin(), spare_.end(), [&](const auto& numbers) {
    return numbers.size() == space.room();
  });
  if (found != spare_.end()) {
    own.numbers.swap(*found);
    spare_.erase(found);
  } else {
    own.numbers.assign(space.room(), 0.0);
  }
  return own.numbers.data();
}

void RowWorker::drop(int vector) {
  const auto own = vectors_.find(vector);
  if (own == vectors_.end()) return;
  if (spare_.size() == kMostSpare) spare_.erase(spare_.begin());
  spare_.push_back(std::move(own->second.numbers));
  vectors_.erase(own);
}

std::span<const double> RowWorker::work(std::span<const std::byte> program, RowPeers& peers) {
  sums_.clear();
  Take take(program);
  const Space* space = nullptr;
  while (!take.is_at_end()) {
    const auto task = take.next<RowTask>();
    if (task == RowTask::space) {
      space = spaces_.at(take.next<int>()).get();
    } else {
      do_task(task, *space, take, peers);
    }
  }
  return sums_;
}

void RowWorker::do_task(RowTask task, const Space& space, Take& take, RowPeers& peers) {
  switch (task) {
    case RowTask::space:
      break;
    case RowTask::drop:
      drop(take.next<int>());
      break;
    case RowTask::combine:
      combine(space, take);
      break;
    case RowTask::multiply:
      multiply(space, take, peers);
      break;
    case RowTask::add_row_loads:
      add_row_loads(space, take);
      break;
    case RowTask::row_products:
      multiply_rows(space, take);
      break;
    case RowTask::pick:
      pick(space, take);
      break;
    case RowTask::compare:
      compare(space, take);
      break;
    case RowTask::total:
      add_total(space, take);
      break;
    case RowTask::square:
      add_square(space, take);
      break;
    case RowTask::inner_product:
      add_inner_product(space, take);
      break;
    case RowTask::largest_norm:
      find_largest_norm(space, take, peers);
      break;
    case RowTask::scale:
      scale(space, take);
      break;
    case RowTask::multiply_mass:
    case RowTask::couple:
    case RowTask::moments:
    case RowTask::subtract:
    case RowTask::resultants:
    case RowTask::subtract_load:
      do_inertia(task, space, take, peers);
      break;
    case RowTask::pair_products:
    case RowTask::subtract_loads:
    case RowTask::combine_answers:
    case RowTask::put_pair:
      do_pairs(task, space, take, peers);
      break;
  }
}

void RowWorker::combine(const Space& space, Take& take) {
  const auto to = take.next<int>();
  const auto adds = take.next<bool>();
  const auto count = take.next<int>();
  Eigen::Map<Vector> y(make_room(space, to), static_cast<Eigen::Index>(space.rows()));
  for (int k = 0; k < count; ++k) {
    const auto weight = take.next<double>();
    const Eigen::Map<const Vector> x(at(take.next<int>()), y.size());
    if (k == 0 && !adds) {
      y = weight * x;
    } else {
      y += weight * x;
    }
  }
  if (count == 0 && !adds) y.setZero();
}

void RowWorker::fill_beside(const Space& space, std::initializer_list<double*> vectors,
                            RowPeers& peers) {
  const RowTables& own = space.tables;
  const int per_unit = own.width * static_cast<int>(vectors.size());
  std::vector<int> out_counts = own.out_counts, in_counts = own.in_counts;
  for (int& count : out_counts) count *= per_unit;
  for (int& count : in_counts) count *= per_unit;
  out_.clear();
  for (const int unit : own.sent) {
    const int first = own.width * unit;
    for (const double* x : vectors) out_.insert(out_.end(), x + first, x + first + own.width);
  }
  in_.resize(place(per_unit) * own.beside.size());
  peers.exchange(out_counts, out_.data(), in_counts, in_.data());
  const double* from = in_.data();
  for (std::size_t k = 0; k < own.beside.size(); ++k) {
    for (double* x : vectors) {
      std::copy_n(from, own.width, x + space.rows() + space.width() * k);
      from += own.width;
    }
  }
}

void RowWorker::multiply(const Space& space, Take& take, RowPeers& peers) {
  double* y = make_room(space, take.next<int>());
  const double* x = at(take.next<int>());
  peers.multiply(take.next<int>(), x, y);
}

void RowWorker::multiply_rows(const Space& space, Take& take) {
  const auto& N = space.tables.N;
  const auto count = take.next<int>();
  for (int k = 0; k < count; ++k) {
    const Eigen::Map<const Vector> x(at(take.next<int>()), N.cols());
    const Vector y = N * x;
    sums_.insert(sums_.end(), y.data(), y.data() + y.size());
  }
}

void RowWorker::pick(const Space& space, Take& take) {
  const double* x = at(take.next<int>());
  const auto count = take.next<int>();
  const int first = space.tables.width * space.tables.first;
  const int end = first + static_cast<int>(space.rows());
  for (int k = 0; k < count; ++k) {
    const auto row = take.next<int>();
    sums_.push_back(row >= first && row < end ? x[row - first] : 0.0);
  }
}

void RowWorker::add_row_loads(const Space& space, Take& take) {
  const auto& N = space.tables.N;
  Eigen::Map<Vector> f(at(take.next<int>()), N.cols());
  Vector weights(N.rows());
  take.take_all(weights.data(), place(static_cast<int>(weights.size())));
  f.noalias() += N.transpose() * weights;
}

void RowWorker::compare(const Space& space, Take& take) {
  const auto n = static_cast<Eigen::Index>(space.rows());
  const auto next = [&] { return Eigen::Map<const Vector>(at(take.next<int>()), n); };
  const auto x = next();
  const auto before = next();
  const auto weights = next();
  const auto of_largest = next();
  double change = 0, size = 0, most = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double moved = x[k] - before[k];
    change += weights[k] * moved * moved;
    size += weights[k] * x[k] * x[k];
    most = std::max(most, std::abs(of_largest[k] * moved));
  }
  sums_.insert(sums_.end(), {change, size, most});
}

void RowWorker::add_total(const Space& space, Take& take) {
  const auto count = take.next<int>();
  double total = 0;
  for (int k = 0; k < count; ++k) {
    const double* x = at(take.next<int>());
    for (std::size_t row = 0; row < space.rows(); ++row) total += x[row];
  }
  sums_.push_back(total);
}

void RowWorker::add_square(const Space& space, Take& take) {
  const Eigen::Map<const Vector> x(at(take.next<int>()), static_cast<Eigen::Index>(space.rows()));
  sums_.push_back(x.squaredNorm());
}

void RowWorker::add_inner_product(const Space& space, Take& take) {
  const auto n = static_cast<Eigen::Index>(space.rows());
  const Eigen::Map<const Vector> x(at(take.next<int>()), n);
  const Eigen::Map<const Vector> y(at(take.next<int>()), n);
  sums_.push_back(x.dot(y));
}

void RowWorker::find_largest_norm(const Space& space, Take& take, RowPeers& peers) {
  const double* x = at(take.next<int>());
  RowPeers::RowsOfBody A{take.next<int>(), space.number, take.next<bool>(), {}};
  A.rows.resize(place(take.next<int>()));
  take.take_all(A.rows.data(), A.rows.size());
  const auto rows = take.next<int>();
  Matrix F(rows, take.next<int>());
  take.take_all(F.data(), place(static_cast<int>(F.size())));
  const std::span<const double> y = peers.multiply(A, x);
  const auto length = static_cast<std::size_t>(F.cols());
  double largest = 0;
  for (std::size_t k = 0; k + length <= y.size(); k += length) {
    const Eigen::Map<const Vector> run(y.data() + k, F.cols());
    largest = std::max(largest, (F * run).squaredNorm());
  }
  sums_.push_back(largest);
}

void RowWorker::scale(const Space& space, Take& take) {
  const auto n = static_cast<Eigen::Index>(space.rows());
  Eigen::Map<Vector> y(make_room(space, take.next<int>()), n);
  const Eigen::Map<const Vector> x(at(take.next<int>()), n);
  const Eigen::Map<const Vector> weights(at(take.next<int>()), n);
  if (take.next<bool>()) {
    y = x.cwiseQuotient(weights);
  } else {
    y = x.cwiseProduct(weights);
  }
}

}  // namespace buckens::linalg
