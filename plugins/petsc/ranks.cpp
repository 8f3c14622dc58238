// SPDX-License-Identifier: Apache-2.0
#include "ranks.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

#include <time.h>

namespace buckens_petsc {

namespace {

enum class Task : int { make, solve, measure, release, leave };

// Waiting processes look for work this often: a thousandth of what a large solve takes.
constexpr long kFirstNap = 20000, kLongestNap = 1000000;  // [ns]
// MPI counts with int.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 28;
constexpr int kDataTag = 1;
constexpr int kMostMotions = 6;

std::unique_ptr<Ranks>& the_ranks() {
  static std::unique_ptr<Ranks> ranks;
  return ranks;
}

MPI_Datatype type_of(const int*) { return MPI_INT; }
MPI_Datatype type_of(const double*) { return MPI_DOUBLE; }

template <class T>
void send(const T* values, std::size_t count, int to, MPI_Comm comm) {
  for (std::size_t first = 0; first < count; first += kMostAtOnce) {
    const auto some = static_cast<int>(std::min(kMostAtOnce, count - first));
    MPI_Send(values + first, some, type_of(values), to, kDataTag, comm);
  }
}

template <class T>
void receive(T* values, std::size_t count, int from, MPI_Comm comm) {
  for (std::size_t first = 0; first < count; first += kMostAtOnce) {
    const auto some = static_cast<int>(std::min(kMostAtOnce, count - first));
    MPI_Recv(values + first, some, type_of(values), from, kDataTag, comm, MPI_STATUS_IGNORE);
  }
}

}  // namespace

/// What is to be done, the same on all processes.
struct Ranks::Order {
  Task task = Task::leave;
  int number = 0;  // of the solver
  int size = 0, block = 1, num_motions = 0, options = 0;
  BuckensGridLimits limits{};
};

/// A solver, and which rows of its matrix are here.
struct Ranks::Part {
  Solver solver;
  std::vector<int> first;  // rows of the processes, and the end
  std::vector<int> counts;
  std::vector<double> b, x;
};

struct Ranks::Shared {
  std::map<int, std::unique_ptr<Part>> parts;  // by number
};

/// Rows of a symmetric matrix, which are its columns.
struct Ranks::OwnRows {
  BuckensGridColumns columns{};  // those below, or the first process's
  std::vector<int> starts, rows;
  std::vector<double> values, motions;
};

Ranks::Ranks() : shared_(std::make_unique<Shared>()) {
  int level = 0;
  int is_running = 0;
  MPI_Initialized(&is_running);
  if (is_running == 0) MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
  MPI_Comm_dup(MPI_COMM_WORLD, &orders_);
  MPI_Comm_dup(MPI_COMM_WORLD, &work_);
  MPI_Comm_rank(work_, &rank_);
  MPI_Comm_size(work_, &count_);
  (void)start_petsc();
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

void Ranks::serve() {
  for (;;) {
    const Order order = wait_for_order();
    BuckensGridOutcome outcome{};
    switch (order.task) {
      case Task::make:
        (void)make_together(order, nullptr);
        break;
      case Task::solve:
        (void)solve_together(order, nullptr, nullptr, outcome);
        break;
      case Task::measure:
        (void)bytes_of(shared_->parts.at(order.number)->solver);
        break;
      case Task::release:
        shared_->parts.erase(order.number);
        break;
      case Task::leave:
        shared_->parts.clear();
        (void)PetscFinalize();
        MPI_Finalize();
        return;
    }
  }
}

void Ranks::leave() {
  give({Task::leave});
  shared_->parts.clear();
  (void)PetscFinalize();
  MPI_Finalize();
  count_ = 1;  // there is nobody left to share with
}

int Ranks::make(const BuckensGridMatrix& matrix) {
  Order order;
  order.task = Task::make;
  order.number = next_++;
  order.size = matrix.size;
  order.block = matrix.block;
  order.num_motions = std::min(matrix.num_motions, kMostMotions);
  order.options = matrix.options == nullptr
                      ? 0
                      : static_cast<int>(std::char_traits<char>::length(matrix.options));
  if (order.size / order.block < count_) {
    set_reason("its " + std::to_string(order.size / order.block) +
               " nodes cannot be divided among " + std::to_string(count_) + " processes");
    return -1;
  }
  give(order);
  return make_together(order, &matrix) ? order.number : -1;
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

/// Of the first process: gives the others their rows, one after the other, and finds its own last,
/// so that it never holds those of two.
bool Ranks::send_rows(const Part& part, const BuckensGridMatrix& matrix, OwnRows& own) {
  bool has_memory = true;
  for (int k = count_ - 1; k >= 0; --k) {
    const int from = part.first[k];
    const int rows = part.counts[k];
    BuckensGridColumns columns{};
    if (matrix.give != nullptr) {
      matrix.give(matrix.source, from, from + rows, &columns);
    } else {
      columns = matrix.all;
      columns.starts += from;
    }
    has_memory = has_memory && columns.starts != nullptr;
    if (k == 0) {
      own.columns = columns;
      break;
    }
    const int first = has_memory ? columns.starts[0] : 0;
    const int entries = has_memory ? columns.starts[rows] - first : -1;
    send_counted(&entries, 1, k);
    if (has_memory) {
      send_counted(columns.starts, static_cast<std::size_t>(rows) + 1, k);
      send_counted(columns.rows + first, static_cast<std::size_t>(entries), k);
      send_counted(columns.values + first, static_cast<std::size_t>(entries), k);
    }
    for (int m = 0; m < std::min(matrix.num_motions, kMostMotions); ++m) {
      send_counted(matrix.motions + static_cast<std::size_t>(m) * matrix.size + from,
                   static_cast<std::size_t>(rows), k);
    }
  }
  return has_memory;
}

template <class T>
void Ranks::send_counted(const T* values, std::size_t count, int to) {
  send(values, count, to, work_);
  traffic_.messages += 1;
  traffic_.bytes += static_cast<double>(count * sizeof(T));
}

/// Of the others: what send_rows() sends.
bool Ranks::receive_rows(int count, int num_motions, OwnRows& own) {
  int entries = 0;
  receive(&entries, 1, 0, work_);
  if (entries >= 0) {
    own.starts.resize(static_cast<std::size_t>(count) + 1);
    own.rows.resize(static_cast<std::size_t>(entries));
    own.values.resize(own.rows.size());
    receive(own.starts.data(), own.starts.size(), 0, work_);
    receive(own.rows.data(), own.rows.size(), 0, work_);
    receive(own.values.data(), own.values.size(), 0, work_);
    for (std::size_t k = own.starts.size(); k-- > 0;) own.starts[k] -= own.starts[0];
    own.columns = {own.starts.data(), own.rows.data(), own.values.data()};
  }
  own.motions.resize(static_cast<std::size_t>(count) * num_motions);
  for (int m = 0; m < num_motions; ++m) {
    receive(own.motions.data() + static_cast<std::size_t>(m) * count,
            static_cast<std::size_t>(count), 0, work_);
  }
  return entries >= 0;
}

/// Which rows are whose: equal runs of nodes.
std::unique_ptr<Ranks::Part> Ranks::divide(const Order& order) const {
  auto part = std::make_unique<Part>();
  const int nodes = order.size / order.block;
  for (int k = 0; k <= count_; ++k) {
    part->first.push_back(static_cast<int>(static_cast<long>(nodes) * k / count_) * order.block);
  }
  part->first.back() = order.size;
  for (int k = 0; k < count_; ++k) part->counts.push_back(part->first[k + 1] - part->first[k]);
  return part;
}

bool Ranks::make_together(const Order& order, const BuckensGridMatrix* matrix) {
  std::unique_ptr<Part> part = divide(order);
  const int count = part->counts[rank_];
  std::string options(static_cast<std::size_t>(order.options), ' ');
  if (matrix != nullptr && matrix->options != nullptr) options = matrix->options;
  MPI_Bcast(options.data(), order.options, MPI_CHAR, 0, work_);
  OwnRows own;
  const bool is_complete = matrix != nullptr ? send_rows(*part, *matrix, own)
                                             : receive_rows(count, order.num_motions, own);
  if (!is_complete) set_reason("there is too little memory for the rows of the matrix");
  if (has_failed_somewhere(!is_complete)) return false;
  Rows rows;
  rows.size = order.size;
  rows.count = count;
  rows.block = order.block;
  rows.num_motions = order.num_motions;
  rows.options = options.c_str();
  rows.starts = own.columns.starts;
  rows.columns = own.columns.rows;
  rows.values = own.columns.values;
  rows.motions = matrix != nullptr ? matrix->motions : own.motions.data();
  rows.stride = matrix != nullptr ? order.size : count;
  rows.release = [&own, matrix] {
    own = OwnRows();
    if (matrix != nullptr && matrix->give != nullptr) matrix->give(matrix->source, 0, 0, nullptr);
  };
  bool has_failed = false;
  {
    const KeptErrors errors;
    has_failed = make_solver(work_, rows, part->solver) != 0;
  }
  if (has_failed_somewhere(has_failed)) return false;
  part->b.resize(static_cast<std::size_t>(count));
  part->x.resize(static_cast<std::size_t>(count));
  shared_->parts[order.number] = std::move(part);
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
  scatter(b, part.b);
  if (!part.solver.is_direct) scatter(x, part.x);
  bool has_failed = false;
  {
    const KeptErrors errors;
    has_failed =
        buckens_petsc::solve(part.solver, part.b.data(), part.x.data(), order.limits, outcome) != 0;
  }
  if (has_failed_somewhere(has_failed)) return false;
  MPI_Gatherv(part.x.data(), count, MPI_DOUBLE, x, part.counts.data(), part.first.data(),
              MPI_DOUBLE, 0, work_);
  traffic_.messages += count_ - 1;
  traffic_.bytes += sizeof(double) * static_cast<double>(part.first[count_] - part.first[1]);
  return true;
}

double Ranks::bytes(int number) {
  give({Task::measure, number});
  return bytes_of(shared_->parts.at(number)->solver);
}

void Ranks::release(int number) {
  give({Task::release, number});
  shared_->parts.erase(number);
}

}  // namespace buckens_petsc
