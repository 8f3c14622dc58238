// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/iterative_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/stopwatch.h"
#include "buckens/base/timed_phase.h"
#include "buckens/base/work.h"
#include "buckens/linalg/finite_matrix.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/single_thread.h"

namespace buckens::linalg {

namespace {

// Share of what the estimate lacks that may be left at most.
constexpr double kLeftOfEstimate = 1e-8;
// Matrices from this size on are worth a word to those who wait.
constexpr Eigen::Index kToldSize = 100000;

}  // namespace

struct IterativeSolver::Solver {
  const BuckensGridPlugin* plugin = nullptr;
  void* handle = nullptr;
  double bytes = 0;
  IterationCounts counts;  // guarded by turn_of_grid_solver()

  ~Solver() {
    const std::scoped_lock lock(turn_of_grid_solver());
    if (handle != nullptr) plugin->release(handle);
  }
};

IterativeSolver::IterativeSolver(SparseMatrix A, const Matrix& motions,
                                 const IterationSettings& settings)
    : size_(A.rows()), settings_(settings), solver_(std::make_unique<Solver>()) {
  A.makeCompressed();
  if (Ranks::count() > 1) {
    MatrixSum alone;
    alone.add(1.0, A);
    share(alone, motions);
    return;
  }
  keep(A, motions);
}

IterativeSolver::IterativeSolver(const MatrixSum& A, const Matrix& motions,
                                 const IterationSettings& settings)
    : size_(A.size()), settings_(settings), solver_(std::make_unique<Solver>()) {
  if (Ranks::count() > 1) {
    share(A, motions);
  } else {
    SparseMatrix whole = A.whole();
    keep(whole, motions);
  }
}

void IterativeSolver::keep(SparseMatrix& A, const Matrix& motions) {
  require_finite(A);
  A_.swap(A);  // Eigen would copy it instead of moving it
  entries_ = static_cast<double>(A_.nonZeros());
  BuckensGridMatrix matrix{};
  matrix.all = {A_.outerIndexPtr(), A_.innerIndexPtr(), A_.valuePtr()};
  make(matrix, motions);
}

void IterativeSolver::share(const MatrixSum& A, const Matrix& motions) {
  A.require_finite();
  // The others wait for columns while the solver is made and cannot be asked for what they hold.
  A.form_terms();
  ColumnSource columns(A);
  BuckensGridMatrix matrix{};
  matrix.give = ColumnSource::give;
  matrix.source = &columns;
  make(matrix, motions);
  entries_ = columns.entries();
}

/// @param matrix its entries; the rest is found here
void IterativeSolver::make(BuckensGridMatrix matrix, const Matrix& motions) {
  const base::TimedPhase phase("factor");
  solver_->plugin = &grid_solver();
  const base::Stopwatch watch;
  base::Work work;
  work.name = fmt::format("coarsening {} equations", size_);
  work.stage = "multigrid";
  if (size_ >= kToldSize) base::report_work(work);
  matrix.size = static_cast<int>(size_);
  matrix.block = settings_.block;
  matrix.num_motions = static_cast<int>(motions.cols());
  matrix.motions = motions.data();
  matrix.options = settings_.options.c_str();
  std::array<char, 400> error{};
  {
    const std::scoped_lock lock(turn_of_grid_solver());
    const SingleThread single;
    solver_->handle = solver_->plugin->make(&matrix, error.data(), static_cast<int>(error.size()));
    if (solver_->handle != nullptr) solver_->bytes = solver_->plugin->bytes(solver_->handle);
  }
  work.stage.clear();
  if (size_ >= kToldSize) base::report_work(work);
  if (solver_->handle == nullptr) {
    throw NumericalError(
        fmt::format("multigrid for a matrix of size {} failed: {}; {}", size_, error.data(),
                    settings_.options.empty() ? "factorise it, or use a coarser mesh"
                                              : "correct the options of PETSc, or leave them out"));
  }
  solver_->counts.setup_seconds = watch.seconds();
}

IterativeSolver::~IterativeSolver() = default;

double IterativeSolver::num_factor_entries() const { return bytes() / 12.0; }

double IterativeSolver::bytes() const { return 12.0 * entries_ + solver_->bytes; }

IterationCounts IterativeSolver::iteration_counts() const {
  const std::scoped_lock lock(turn_of_grid_solver());
  return solver_->counts;
}

void IterativeSolver::iterate(const double* b, double* x, double energy) const {
  const base::Stopwatch watch;
  const BuckensGridLimits limits{settings_.tolerance * energy, settings_.tolerance,
                                 std::max(kLeftOfEstimate, settings_.tolerance),
                                 settings_.most_iterations};
  BuckensGridOutcome outcome{};
  std::array<char, 400> error{};
  const std::scoped_lock lock(turn_of_grid_solver());
  const SingleThread single;
  const int failure = solver_->plugin->solve(solver_->handle, b, x, &limits, &outcome, error.data(),
                                             static_cast<int>(error.size()));
  ++solver_->counts.solves;
  solver_->counts.iterations += outcome.iterations;
  solver_->counts.seconds += watch.seconds();
  if (failure == 0 && outcome.has_converged != 0) return;
  throw NumericalError(
      failure != 0
          ? fmt::format("conjugate gradients on a matrix of size {} failed: {}; factorise "
                        "it",
                        size_, error.data())
          : fmt::format("conjugate gradients on a matrix of size {} have not converged in {} "
                        "iterations (the error fell from {:.3g} to {:.3g}); factorise it, use a "
                        "shorter step, or a mesh without very flat elements",
                        size_, outcome.iterations, outcome.first, outcome.last));
}

void IterativeSolver::improve(const Vector& b, Vector& x, double energy) const {
  const double found = energy > 0.0 ? energy : std::sqrt(std::abs(b.dot(x)));
  iterate(b.data(), x.data(), std::isfinite(found) ? found : 0.0);
}

void IterativeSolver::solve(const double* B, double* X, Eigen::Index columns,
                            TaskPool* /*pool*/) const {
  Vector b(size());
  for (Eigen::Index k = 0; k < columns; ++k) {
    b = Eigen::Map<const Vector>(B + k * size(), size());
    double* x = X + k * size();
    std::fill_n(x, size(), 0.0);
    iterate(b.data(), x, 0.0);
  }
}

void IterativeSolver::solve_in_place(std::span<double* const> vectors, TaskPool* pool) const {
  for (double* x : vectors) solve(x, x, 1, pool);
}

}  // namespace buckens::linalg
