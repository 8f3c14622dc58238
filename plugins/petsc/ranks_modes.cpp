// SPDX-License-Identifier: Apache-2.0
// Modes of a divided body: all vectors have the runs of rows of its mass matrix.
#include <algorithm>
#include <array>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

#include "abort_alone.h"
#include "ranks_messages.h"
#include "ranks_parts.h"
#include "reasons.h"

namespace buckens_petsc {

namespace {

constexpr std::size_t kStiffness = 0, kMass = 1;  // in Order::of
// How long processes that fail together may be apart, and how much longer the next one waits, so
// that of several which do not know of all others one tells it.
constexpr std::chrono::milliseconds kTogether{5000}, kAfterTheOther{200};
// Vectors beside the basis: those of a product, and of SLEPc.
constexpr int kOtherVectors = 16;

/// With so many vectors more than wanted ones, restarts are few.
int size_of_basis(int wanted) { return std::max(2 * wanted, wanted + 32); }

}  // namespace

bool Ranks::find_modes(int solver, BuckensGridModes& modes) {
  Order order;
  order.task = Task::find_modes;
  order.number = solver;
  const std::array<int, 2> matrices = {modes.stiffness, modes.mass};
  order.set_matrices(matrices.data(), static_cast<int>(matrices.size()));
  give(order);
  return find_modes_together(order, &modes);
}

/// Whether there seems to be room for all vectors here, and for their products: a process that
/// lacks memory later, while others wait for it, has to end the run.
bool Ranks::has_room_for_modes(const Order& order, const BuckensGridModes& modes) {
  const Divided& K = *shared_->matrices.at(order.of[kStiffness]);
  const Divided& M = *shared_->matrices.at(order.of[kMass]);
  const auto here = static_cast<std::size_t>(M.counts[rank_]);
  const auto vectors = static_cast<std::size_t>(size_of_basis(modes.count) + 2 * modes.count +
                                                modes.num_motions + kOtherVectors);
  return has_memory_for([&] {
    const std::size_t most = std::max(K.variables.size(), M.variables.size());
    shared_->share.reserve(most);
    shared_->results.reserve(most);
    ::operator delete(::operator new(sizeof(double) * here * vectors));
  });
}

/// Whether a search has failed in all processes, which then tell it together. Otherwise the others
/// are still searching, or wait for shapes.
bool Ranks::have_all_failed() {
  using Clock = std::chrono::steady_clock;
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(work_, &all);
  int is_complete = 0;
  const Clock::time_point end = Clock::now() + kTogether + rank_ * kAfterTheOther;
  while (is_complete == 0 && Clock::now() < end) {
    MPI_Test(&all, &is_complete, MPI_STATUS_IGNORE);
    if (is_complete == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return is_complete != 0;
}

/// Rows of rigid motions here, one motion after the other.
std::vector<double> Ranks::share_motions(const Divided& M, const BuckensGridModes& modes,
                                         const double* all) {
  const int here = M.counts[rank_];
  std::vector<double> rows(static_cast<std::size_t>(here) * modes.num_motions);
  for (int k = 0; k < modes.num_motions; ++k) {
    const double* from = all != nullptr ? all + static_cast<std::size_t>(k) * M.size : nullptr;
    MPI_Scatterv(from, M.counts.data(), M.first.data(), MPI_DOUBLE,
                 rows.data() + static_cast<std::size_t>(k) * here, here, MPI_DOUBLE, 0, work_);
  }
  count_messages(modes.num_motions * (count_ - 1), 0);
  traffic_.bytes += sizeof(double) * modes.num_motions * static_cast<double>(M.size);
  return rows;
}

/// What the search has to know, of rows as those of M. @param way to the rows of the factor
/// @param inertia rows for a product, as those behind `problem`
void Ranks::describe_modes(const Order& order, const BuckensGridModes& modes, Way& way,
                           std::vector<double>& inertia, ModeProblem& problem) {
  Part& part = *shared_->parts.at(order.number);
  const int mass = order.of[kMass];
  const int stiffness = order.of[kStiffness];
  const Divided& M = *shared_->matrices.at(mass);
  const int here = M.counts[rank_];
  inertia.resize(static_cast<std::size_t>(here));
  problem.first = M.first[rank_];
  problem.count = here;
  problem.wanted = modes.count;
  problem.basis = size_of_basis(modes.count);
  problem.tolerance = modes.tolerance;
  problem.num_motions = modes.num_motions;
  // The first process has no rows: of the work on vectors it does its share of solves.
  const auto multiply = [this](int matrix, const double* x, double* y) {
    if (rank_ != 0) multiply_among_others(matrix, x, y);
  };
  problem.multiply_mass = [=](const double* x, double* y) { multiply(mass, x, y); };
  problem.multiply_inner = [=, &inertia, shift = modes.shift](const double* x, double* y) {
    multiply(stiffness, x, y);
    multiply(mass, x, inertia.data());
    for (int k = 0; k < here; ++k) y[k] += shift * inertia[static_cast<std::size_t>(k)];
  };
  problem.solve = [this, &part, &way](const double* b, double* x) {
    return solve_by(part, way, b, x);
  };
}

bool Ranks::find_modes_together(const Order& order, BuckensGridModes* modes) {
  const SolverLibrary* library = solver_library();
  if (has_failed_somewhere(library == nullptr)) return false;
  BuckensGridModes wish{};
  if (modes != nullptr) wish = *modes;
  MPI_Bcast(&wish, sizeof wish, MPI_BYTE, 0, work_);
  count_messages(count_ - 1, sizeof wish);
  if (has_failed_somewhere(!has_room_for_modes(order, wish))) return false;
  const Divided& M = *shared_->matrices.at(order.of[kMass]);
  const std::vector<double> motions =
      share_motions(M, wish, modes != nullptr ? modes->motions : nullptr);
  Way way(shared_->parts.at(order.number)->factor->variables(), M.first.data(), work_);
  std::vector<double> inertia;
  ModeProblem problem;
  describe_modes(order, wish, way, inertia, problem);
  problem.motions = motions.data();
  problem.take = [&](int number, double theta, const double* x) {
    double* to = nullptr;
    if (modes != nullptr) {
      modes->theta[number] = theta;
      to = modes->shapes + static_cast<std::size_t>(number) * M.size;
    }
    MPI_Gatherv(x, M.counts[rank_], MPI_DOUBLE, to, M.counts.data(), M.first.data(), MPI_DOUBLE, 0,
                work_);
    count_messages(count_ - 1, 0);
    traffic_.bytes += sizeof(double) * static_cast<double>(M.size);
  };
  std::string reason;
  const ModeSearch search = library->find_modes(work_, problem, reason);
  if (search.end == ModeSearch::End::solve_failed) return false;  // all know the reason
  if (search.has_failed()) {
    if (have_all_failed()) {
      set_reason(reason);
      return false;
    }
    abort_alone(rank_, reason.c_str(),
                search.end == ModeSearch::End::out_of_memory ? "use more memory"
                                                             : "take the method subspace");
  }
  if (modes != nullptr) {
    modes->found = search.found;
    modes->restarts = search.restarts;
    modes->solves = search.solves;
  }
  return true;
}

}  // namespace buckens_petsc
