// SPDX-License-Identifier: Apache-2.0
// Pairs of loads and answers in single precision, of which each process but the first has a run of
// rows. Arithmetic with them is in double precision.
#include <algorithm>
#include <array>
#include <vector>

#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {

// Sums that do not wait for each other.
constexpr int kLanes = 8;

template <class A>
double dot(const A* a, const double* b, std::size_t count) {
  std::array<double, kLanes> sums{};
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      sums[lane] += static_cast<double>(a[k + lane]) * b[k + lane];
    }
  }
  for (; k < count; ++k) sums[0] += static_cast<double>(a[k]) * b[k];
  double out = 0;
  for (const double sum : sums) out += sum;
  return out;
}

void add(double factor, const float* from, std::size_t count, double* to) {
  for (std::size_t k = 0; k < count; ++k) to[k] += factor * static_cast<double>(from[k]);
}

MPI_Datatype kind_of(const float* /*values*/) { return MPI_FLOAT; }
MPI_Datatype kind_of(const double* /*values*/) { return MPI_DOUBLE; }

}  // namespace

int Ranks::make_pairs(int size, const BuckensGridRows& rows, int most) {
  const Order order = give_new(Task::make_pairs, size, most, &rows);
  return make_pairs_together(order, &rows) ? order.number : -1;
}

bool Ranks::make_pairs_together(const Order& order, const BuckensGridRows* of) {
  auto pairs = std::make_unique<Pairs>();
  pairs->first = agreed_runs(order, of);
  for (int k = 0; k < count_; ++k) pairs->counts.push_back(pairs->first[k + 1] - pairs->first[k]);
  const auto here = static_cast<std::size_t>(pairs->counts[rank_]);
  const bool has_room = has_memory_for([&] {
    // Pages of memory come into being as they are written to.
    pairs->loads.reset(new float[here * static_cast<std::size_t>(order.columns)]);
    pairs->answers.reset(new float[here * static_cast<std::size_t>(order.columns)]);
    pairs->row.resize(here);
  });
  if (has_failed_somewhere(!has_room)) return false;
  shared_->pairs[order.number] = std::move(pairs);
  return true;
}

/// Rows of a vector of the first process to those who have them, or back.
template <class T>
void Ranks::scatter(const Pairs& pairs, const T* whole, T* here) {
  const MPI_Datatype kind = kind_of(here);
  MPI_Scatterv(whole, pairs.counts.data(), pairs.first.data(), kind, here, pairs.counts[rank_],
               kind, 0, work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(T) * static_cast<double>(pairs.first.back());
}

template <class T>
void Ranks::gather(const Pairs& pairs, const T* here, T* whole) {
  const MPI_Datatype kind = kind_of(here);
  MPI_Gatherv(here, pairs.counts[rank_], kind, whole, pairs.counts.data(), pairs.first.data(), kind,
              0, work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(T) * static_cast<double>(pairs.first.back());
}

/// Of all processes, in their order, on the first: so the same in every run.
void Ranks::sum_in_order(std::vector<double>& values) {
  const auto count = values.size();
  std::vector<double> all(rank_ == 0 ? count * static_cast<std::size_t>(count_) : 0);
  MPI_Gather(values.data(), static_cast<int>(count), MPI_DOUBLE, all.data(),
             static_cast<int>(count), MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, sizeof(double) * static_cast<double>(count));
  for (std::size_t k = count; k < all.size(); ++k) values[k % count] += all[k];
}

double Ranks::project(int number, int pairs, double* r, double* along) {
  give_pairs(Task::project, number, pairs);
  return project_together(*shared_->pairs.at(number), pairs, r, along);
}

/// @return of the first process: ‖r‖²
double Ranks::project_together(Pairs& own, int pairs, double* r, double* along) {
  const auto here = static_cast<std::size_t>(own.counts[rank_]);
  const auto count = static_cast<std::size_t>(pairs);
  scatter(own, r, own.row.data());
  std::vector<double> sums(count, 0.0);
  for (std::size_t i = 0; i < count && rank_ != 0; ++i) {
    sums[i] = dot(own.loads.get() + i * here, own.row.data(), here);
  }
  sum_in_order(sums);
  MPI_Bcast(sums.data(), pairs, MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, sizeof(double) * static_cast<double>(count));
  if (rank_ == 0) std::copy(sums.begin(), sums.end(), along);
  for (std::size_t i = 0; i < count && rank_ != 0; ++i) {
    add(-sums[i], own.loads.get() + i * here, here, own.row.data());
  }
  for (double& value : own.row) value = static_cast<double>(static_cast<float>(value));
  std::vector<double> square = {dot(own.row.data(), own.row.data(), here)};
  sum_in_order(square);
  gather(own, own.row.data(), r);
  return square.front();
}

void Ranks::combine(int number, int pairs, const double* weights, double* sum) {
  give_pairs(Task::combine, number, pairs);
  combine_together(*shared_->pairs.at(number), pairs, weights, sum);
}

void Ranks::combine_together(Pairs& own, int pairs, const double* weights, double* sum) {
  const auto here = static_cast<std::size_t>(own.counts[rank_]);
  const auto count = static_cast<std::size_t>(pairs);
  std::vector<double> shares(count);
  if (weights != nullptr) shares.assign(weights, weights + count);
  MPI_Bcast(shares.data(), pairs, MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, sizeof(double) * static_cast<double>(count));
  std::fill(own.row.begin(), own.row.end(), 0.0);
  for (std::size_t i = 0; i < count && rank_ != 0; ++i) {
    add(shares[i], own.answers.get() + i * here, here, own.row.data());
  }
  gather(own, own.row.data(), sum);
}

void Ranks::put_pair(int number, int pair, const float* load, const float* answer) {
  give_pairs(Task::put_pair, number, pair);
  put_pair_together(*shared_->pairs.at(number), pair, load, answer);
}

void Ranks::put_pair_together(Pairs& own, int pair, const float* load, const float* answer) {
  scatter(own, load, own.of(own.loads, pair, rank_));
  scatter(own, answer, own.of(own.answers, pair, rank_));
}

void Ranks::take_pair(int number, int pair, float* load, float* answer) {
  give_pairs(Task::take_pair, number, pair);
  take_pair_together(*shared_->pairs.at(number), pair, load, answer);
}

void Ranks::take_pair_together(Pairs& own, int pair, float* load, float* answer) {
  gather(own, own.of(own.loads, pair, rank_), load);
  gather(own, own.of(own.answers, pair, rank_), answer);
}

/// @param count of pairs, or which
void Ranks::give_pairs(Task task, int number, int count) {
  Order order;
  order.task = task;
  order.number = number;
  order.columns = count;
  give(order);
}

/// Of the others.
void Ranks::serve_pairs(const Order& order) {
  if (order.task == Task::make_pairs) {
    (void)make_pairs_together(order, nullptr);
    return;
  }
  Pairs& own = *shared_->pairs.at(order.number);
  switch (order.task) {
    case Task::project:
      (void)project_together(own, order.columns, nullptr, nullptr);
      break;
    case Task::combine:
      combine_together(own, order.columns, nullptr, nullptr);
      break;
    case Task::put_pair:
      put_pair_together(own, order.columns, nullptr, nullptr);
      break;
    default:
      take_pair_together(own, order.columns, nullptr, nullptr);
  }
}

}  // namespace buckens_petsc
