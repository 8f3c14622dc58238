// SPDX-License-Identifier: Apache-2.0
// Vectors of which each process but the first has a run of rows, and work on them.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <vector>

#include "abort_alone.h"
#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {

constexpr std::size_t kVector = 0, kAnswer = 1, kSolver = 2;  // in Order::of
constexpr int kReason = 400;                                  // characters
constexpr double kHasFailed = 1.0;

}  // namespace

/// Among the others; a Ranks as context.
void Ranks::exchange_numbers(void* context, const int* out_counts, const double* out,
                             const int* in_counts, double* in) {
  const Ranks& own = *static_cast<Ranks*>(context);
  const std::vector<int> out_first = starts_of({out_counts, out_counts + own.count_ - 1});
  const std::vector<int> in_first = starts_of({in_counts, in_counts + own.count_ - 1});
  MPI_Alltoallv(out, out_counts, out_first.data(), MPI_DOUBLE, in, in_counts, in_first.data(),
                MPI_DOUBLE, own.others_);
}

int Ranks::multiply_here(void* context, int matrix, const double* x, double* y) {
  Ranks& own = *static_cast<Ranks*>(context);
  const bool is_done = has_memory_for([&] { own.multiply_among_others(matrix, x, y); });
  return is_done ? 0 : 1;
}

int Ranks::multiply_rows_here(void* context, int matrix, int number, int is_new, const int* rows,
                              const double* x, const double** y, int* count) {
  Ranks& own = *static_cast<Ranks*>(context);
  Divided& A = *own.shared_->matrices.at(matrix);
  const bool is_done = has_memory_for([&] {
    if (is_new != 0) {
      std::vector<int> wanted = A.variables;
      for (int& row : wanted) row = rows != nullptr ? rows[row] : row;
      const Runs& runs = own.shared_->runs.at(number);
      A.way = std::make_unique<Way>(wanted, runs.first.data() + 1, own.others_);
    }
    own.multiply_rows_among_others(A, x);
  });
  *y = own.shared_->results.data();
  *count = A.counts[own.rank_];
  return is_done ? 0 : 1;
}

void Ranks::find_pairs(void* context, int number, float** loads, float** answers) {
  const Pairs& pairs = *static_cast<Ranks*>(context)->shared_->pairs.at(number);
  *loads = pairs.loads.get();
  *answers = pairs.answers.get();
}

void Ranks::runs(int size, int* first) const {
  const std::vector<int> all = runs_of_others(size, count_);
  std::copy(all.begin() + 1, all.end(), first);
}

int Ranks::begin_rows(int size, const BuckensGridRows& rows, const BuckensGridDescription& of) {
  const Order order = give_new(Task::begin_rows, size, 0, &rows);
  return begin_rows_together(order, &rows, &of) ? order.number : -1;
}

bool Ranks::begin_rows_together(const Order& order, const BuckensGridRows* rows,
                                const BuckensGridDescription* of) {
  Runs runs;
  runs.first = agreed_runs(order, rows);
  for (int k = 0; k < count_; ++k) runs.counts.push_back(runs.first[k + 1] - runs.first[k]);
  bool is_made = false;
  if (of != nullptr) {
    is_made = send_descriptions(runs.first, *of);
  } else {
    std::vector<char> description;
    is_made = receive_description(description);
    std::array<char, kReason> error{};
    if (is_made &&
        maker_.begin_rows(order.number, description.data(), static_cast<long>(description.size()),
                          error.data(), kReason) != 0) {
      set_reason(error.data());
      is_made = false;
    }
  }
  if (has_failed_somewhere(!is_made)) {
    if (is_made && rank_ != 0) maker_.end_rows(order.number);
    return false;
  }
  shared_->runs[order.number] = std::move(runs);
  return true;
}

bool Ranks::work_rows(const void* program, long count, int sums_each, double* sums) {
  Order order;
  order.task = Task::work_rows;
  order.columns = sums_each;
  order.bytes = count;
  give(order);
  return work_rows_together(order, program, sums);
}

bool Ranks::work_rows_together(const Order& order, const void* program, double* sums) {
  std::vector<char> bytes(static_cast<std::size_t>(order.bytes));
  if (rank_ == 0) std::memcpy(bytes.data(), program, bytes.size());
  MPI_Bcast(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, 0, work_);
  count_messages(count_ - 1, static_cast<double>(bytes.size()));
  if (rank_ == 0) return receive_sums(static_cast<std::size_t>(order.columns), sums);
  const double* own = nullptr;
  long num_sums = 0;
  std::array<char, kReason> error{};
  const BuckensGridPeers peers{exchange_numbers, multiply_here, multiply_rows_here, find_pairs,
                               this};
  const bool is_done = maker_.work_rows(bytes.data(), order.bytes, &peers, &own, &num_sums,
                                        error.data(), kReason) == 0;
  // One number more tells whether that went well, so that nobody waits for an answer.
  std::vector<double> reply(static_cast<std::size_t>(order.columns) + 1, kHasFailed);
  if (is_done && num_sums == order.columns) {
    std::copy_n(own, num_sums, reply.begin());
    reply.back() = 0.0;
  } else if (is_done) {
    std::snprintf(error.data(), kReason, "%s", "a program asked for other sums than it got");
  }
  if (reply.back() != 0.0 && count_ > 2) {
    // The others may be waiting for numbers of this process, which it no longer has.
    abort_alone(rank_, error.data(), "use more memory");
  }
  send(reply.data(), reply.size(), 0, work_);
  if (reply.back() != 0.0) send(error.data(), kReason, 0, work_);
  return reply.back() == 0.0;
}

/// Of the first: process after process.
bool Ranks::receive_sums(std::size_t each, double* sums) {
  std::vector<double> reply(each + 1);
  std::array<char, kReason> error{};
  bool are_done = true;
  for (int k = 1; k < count_; ++k) {
    receive(reply.data(), reply.size(), k, work_);
    count_messages(1, static_cast<double>(reply.size() * sizeof(double)));
    if (reply.back() == 0.0) {
      std::copy_n(reply.begin(), each, sums + each * static_cast<std::size_t>(k - 1));
      continue;
    }
    receive(error.data(), kReason, k, work_);
    set_reason(error.data());
    are_done = false;
  }
  return are_done;
}

bool Ranks::put_rows(int number, int vector, const double* values) {
  Order order;
  order.task = Task::put_rows;
  order.number = number;
  order.of[kVector] = vector;
  give(order);
  return put_rows_together(order, values);
}

bool Ranks::put_rows_together(const Order& order, const double* values) {
  const Runs& runs = shared_->runs.at(order.number);
  double* own = rank_ != 0 ? maker_.rows(order.number, order.of[kVector]) : nullptr;
  const bool lacks_room = rank_ != 0 && own == nullptr;
  if (lacks_room) set_reason("there is too little memory for the rows of a vector");
  if (has_failed_somewhere(lacks_room)) return false;
  MPI_Scatterv(values, runs.counts.data(), runs.first.data(), MPI_DOUBLE, own, runs.counts[rank_],
               MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(double) * static_cast<double>(runs.first.back());
  return true;
}

void Ranks::take_rows(int number, int vector, double* values) {
  Order order;
  order.task = Task::take_rows;
  order.number = number;
  order.of[kVector] = vector;
  give(order);
  take_rows_together(order, values);
}

void Ranks::take_rows_together(const Order& order, double* values) {
  const Runs& runs = shared_->runs.at(order.number);
  const double* own = rank_ != 0 ? maker_.rows(order.number, order.of[kVector]) : nullptr;
  MPI_Gatherv(own, runs.counts[rank_], MPI_DOUBLE, values, runs.counts.data(), runs.first.data(),
              MPI_DOUBLE, 0, work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(double) * static_cast<double>(runs.first.back());
}

bool Ranks::solve_rows(int solver, int number, int b, int x) {
  Order order;
  order.task = Task::solve_rows;
  order.number = number;
  order.of = {b, x, solver};
  give(order);
  return solve_rows_together(order);
}

bool Ranks::solve_rows_together(const Order& order) {
  Part& part = *shared_->parts.at(order.of[kSolver]);
  double* b = nullptr;
  double* x = nullptr;
  if (rank_ != 0) {
    x = maker_.rows(order.number, order.of[kAnswer]);
    b = maker_.rows(order.number, order.of[kVector]);
  }
  const bool lacks_room = rank_ != 0 && (x == nullptr || b == nullptr);
  if (lacks_room) set_reason("there is too little memory for the rows of a vector");
  if (has_failed_somewhere(lacks_room)) return false;
  if (!part.way) {
    const Runs& runs = shared_->runs.at(order.number);
    part.way = std::make_unique<Way>(part.factor->variables(), runs.first.data(), work_);
  }
  return solve_by(part, *part.way, b, x);
}

/// x = A⁻¹ b of vectors of which the others have rows. @param way from these to those of the factor
bool Ranks::solve_by(Part& part, Way& way, const double* b, double* x) {
  way.bring(b, part.b.data());
  const bool has_failed = !part.factor->solve(part.b.data(), part.x.data());
  way.give_back(part.x.data(), x, false);
  count_messages(2 * (count_ - 1), 0);
  traffic_.bytes += 2.0 * sizeof(double) * static_cast<double>(way.in.size());  // of the first's
  return !has_failed_somewhere(has_failed);
}

/// Of the others.
void Ranks::serve_rows(const Order& order) {
  switch (order.task) {
    case Task::begin_rows:
      (void)begin_rows_together(order, nullptr, nullptr);
      break;
    case Task::work_rows:
      (void)work_rows_together(order, nullptr, nullptr);
      break;
    case Task::put_rows:
      (void)put_rows_together(order, nullptr);
      break;
    case Task::take_rows:
      take_rows_together(order, nullptr);
      break;
    case Task::find_modes:
      (void)find_modes_together(order, nullptr);
      break;
    default:
      (void)solve_rows_together(order);
  }
}

}  // namespace buckens_petsc
