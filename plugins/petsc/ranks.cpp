// SPDX-License-Identifier: Apache-2.0
#include "ranks.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <time.h>

#include "process_memory.h"
#include "ranks_parts.h"
#include "reasons.h"

namespace buckens_petsc {

namespace {

// Waiting processes look for work this often: a thousandth of what a large solve takes.
constexpr long kFirstNap = 20000, kLongestNap = 1000000;  // [ns]

std::unique_ptr<Ranks>& the_ranks() {
  static std::unique_ptr<Ranks> ranks;
  return ranks;
}

}  // namespace

Ranks::Ranks() : shared_(std::make_unique<Shared>()) {
  int level = 0;
  int is_running = 0;
  MPI_Initialized(&is_running);
  if (is_running == 0) MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
  return_large_blocks();
  MPI_Comm_dup(MPI_COMM_WORLD, &orders_);
  MPI_Comm_dup(MPI_COMM_WORLD, &work_);
  MPI_Comm_rank(work_, &rank_);
  MPI_Comm_size(work_, &count_);
  MPI_Comm_split(work_, rank_ == 0 ? MPI_UNDEFINED : 0, rank_, &others_);
}

Ranks& Ranks::join() {
  if (!the_ranks()) the_ranks().reset(new Ranks);
  return *the_ranks();
}

Ranks* Ranks::joined() { return the_ranks().get(); }

void Ranks::give(const Order& order) {
  Order copy = order;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&copy, sizeof copy, MPI_BYTE, 0, orders_, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  count_messages(count_ - 1, sizeof copy);
}

void Ranks::give(Task task, int number) {
  Order order;
  order.task = task;
  order.number = number;
  give(order);
}

Ranks::Order Ranks::give_new(Task task, int rows, int columns, const BuckensGridRows* of) {
  Order order;
  order.task = task;
  order.number = next_++;
  order.size = rows;
  order.columns = columns;
  order.gives_rows = of != nullptr && of->first != nullptr ? 1 : 0;
  give(order);
  return order;
}

void Ranks::count_messages(int messages, double bytes_each) {
  traffic_.messages += messages;
  traffic_.bytes += messages * bytes_each;
}

/// Sleeps in between: the first process needs the processors for everything that is not shared.
Ranks::Order Ranks::wait_for_order() {
  Order order;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&order, sizeof order, MPI_BYTE, 0, orders_, &request);
  timespec nap{0, kFirstNap};
  for (int is_there = 0;;) {
    MPI_Test(&request, &is_there, MPI_STATUS_IGNORE);
    if (is_there != 0) return order;
    nanosleep(&nap, nullptr);
    nap.tv_nsec = std::min(kLongestNap, 2 * nap.tv_nsec);
  }
}

void Ranks::serve(const BuckensGridMaker& maker) {
  maker_ = maker;
  for (;;) {
    const Order order = wait_for_order();
    BuckensGridOutcome outcome{};
    switch (order.task) {
      case Task::make:
        (void)make_together(order, nullptr);
        break;
      case Task::factorise:
        (void)factorise_together(order, nullptr);
        break;
      case Task::solve:
        (void)solve_together(order, nullptr, nullptr, outcome);
        break;
      case Task::measure:
        (void)shared_->parts.at(order.number)->bytes();
        break;
      case Task::release:
        shared_->parts.erase(order.number);
        break;
      case Task::divide:
      case Task::divide_rows:
      case Task::make_rows:
      case Task::make_columns:
      case Task::add_up:
      case Task::inner_product:
      case Task::diagonal:
      case Task::near_diagonal:
      case Task::marks:
      case Task::edges:
      case Task::multiply:
      case Task::gather:
      case Task::partition:
        serve_matrices(order);
        break;
      case Task::forget:
        forget_here(order.number);
        break;
      case Task::begin_rows:
      case Task::work_rows:
      case Task::put_rows:
      case Task::take_rows:
      case Task::solve_rows:
      case Task::find_modes:
        serve_rows(order);
        break;
      case Task::make_pairs:
      case Task::project:
      case Task::combine:
      case Task::put_pair:
      case Task::take_pair:
        serve_pairs(order);
        break;
      case Task::leave:
        end_here();
        return;
    }
  }
}

/// Orders about matrices that the first process does not have, and about meshes of which they are.
void Ranks::serve_matrices(const Order& order) {
  BuckensGridFacts facts{};
  switch (order.task) {
    case Task::divide:
    case Task::divide_rows:
      (void)divide_together(order, nullptr, nullptr, facts);
      break;
    case Task::make_rows:
    case Task::make_columns:
      (void)make_columns_together(order, nullptr, nullptr, facts);
      break;
    case Task::add_up:
      (void)add_up_together(order, nullptr, nullptr, facts);
      break;
    case Task::inner_product:
      (void)inner_product_together(order, nullptr, nullptr);
      break;
    case Task::diagonal:
      diagonal_together(order, nullptr);
      break;
    case Task::near_diagonal:
      near_diagonal_together(order, nullptr, nullptr);
      break;
    case Task::marks:
      (void)marks_together(order, nullptr);
      break;
    case Task::edges:
      (void)edges_together(order, nullptr);
      break;
    case Task::multiply:
      multiply_together(order, nullptr, nullptr);
      break;
    case Task::partition:
      (void)partition_together(order, nullptr, nullptr);
      break;
    default:
      gather_together(order, nullptr, nullptr, nullptr);
  }
}

/// Of the others.
void Ranks::forget_here(int number) {
  if (shared_->runs.count(number) > 0) maker_.end_rows(number);
  shared_->forget(number);
}

void Ranks::end_here() {
  shared_->parts.clear();
  end_solver_library();
  MPI_Finalize();
}

void Ranks::leave() {
  give(Task::leave);
  end_here();
  count_ = 1;  // there is nobody left to share with
}

int Ranks::make(const BuckensGridMatrix& matrix) {
  Order order;
  order.task = matrix.order == nullptr ? Task::make : Task::factorise;
  order.number = next_++;
  order.size = matrix.size;
  order.block = matrix.block;
  order.num_motions = std::min(matrix.num_motions, kMostMotions);
  order.options = matrix.options == nullptr
                      ? 0
                      : static_cast<int>(std::char_traits<char>::length(matrix.options));
  order.set_matrices(matrix.terms, matrix.num_terms);
  if (order.size / order.block < count_) {
    set_reason("its " + std::to_string(order.size / order.block) +
               " nodes cannot be divided among " + std::to_string(count_) + " processes");
    return -1;
  }
  give(order);
  const bool is_made =
      matrix.order == nullptr ? make_together(order, &matrix) : factorise_together(order, &matrix);
  return is_made ? order.number : -1;
}

/// Whether some process has failed is then known to all; why, to the first.
bool Ranks::has_failed_somewhere(bool has_failed) {
  std::array<char, 400> text{};
  const int mine = has_failed ? rank_ : count_;
  int first = count_;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, work_);
  count_messages(2 * (count_ - 1), sizeof mine);  // to the first process, and its answer
  if (first == count_) return false;
  if (rank_ == first) std::snprintf(text.data(), text.size(), "%s", take_reason().c_str());
  MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, first, work_);
  set_reason(text.data());
  return true;
}

bool Ranks::solve(int number, const double* b, double* x, const BuckensGridLimits& limits,
                  BuckensGridOutcome& outcome) {
  Order order;
  order.task = Task::solve;
  order.number = number;
  order.limits = limits;
  give(order);
  return solve_together(order, b, x, outcome);
}

bool Ranks::solve_together(const Order& order, const double* b, double* x,
                           BuckensGridOutcome& outcome) {
  Part& part = *shared_->parts.at(order.number);
  const int count = part.counts[rank_];
  const auto scatter = [&](const double* from, std::vector<double>& to) {
    MPI_Scatterv(from, part.counts.data(), part.first.data(), MPI_DOUBLE, to.data(), count,
                 MPI_DOUBLE, 0, work_);
    traffic_.messages += count_ - 1;
    traffic_.bytes += sizeof(double) * static_cast<double>(part.first[count_] - part.first[1]);
  };
  double* whole = part.variables.empty() ? x : part.whole.data();
  for (std::size_t k = 0; k < part.variables.size(); ++k) whole[k] = b[part.variables[k]];
  scatter(part.variables.empty() ? b : whole, part.b);
  if (!part.is_direct()) scatter(x, part.x);
  bool has_failed = false;
  if (part.factor != nullptr) {
    has_failed = !part.factor->solve(part.b.data(), part.x.data());
    outcome = {1, 0, 0, 1};
  } else {
    std::string reason;
    has_failed = !part.solver->solve(part.b.data(), part.x.data(), order.limits, outcome, reason);
    if (has_failed) set_reason(reason);
  }
  if (has_failed_somewhere(has_failed)) return false;
  MPI_Gatherv(part.x.data(), count, MPI_DOUBLE, whole, part.counts.data(), part.first.data(),
              MPI_DOUBLE, 0, work_);
  for (std::size_t k = 0; k < part.variables.size(); ++k) x[part.variables[k]] = whole[k];
  traffic_.messages += count_ - 1;
  traffic_.bytes += sizeof(double) * static_cast<double>(part.first[count_] - part.first[1]);
  return true;
}

double Ranks::bytes(int number) {
  give(Task::measure, number);
  return shared_->parts.at(number)->bytes();
}

void Ranks::release(int number) {
  give(Task::release, number);
  shared_->parts.erase(number);
}

}  // namespace buckens_petsc
