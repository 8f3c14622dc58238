// SPDX-License-Identifier: Apache-2.0
// What the plug-in asks of this library.
//
// PETSc brings libraries under the GPL into the process: so it is loaded by those runs only that
// ask for its solvers, and nothing else links it.
#include <cstdio>
#include <memory>

#include "modes.h"
#include "solver.h"

namespace buckens_petsc {

namespace {

class SolverOfPetsc final : public LoadedSolver {
 public:
  bool make(const MPI_Comm* comm, const Rows& rows, std::string& reason) {
    if (start_petsc() != 0) {
      reason = take_error();
      return false;
    }
    const KeptErrors errors;
    const bool is_made = make_solver(comm == nullptr ? PETSC_COMM_SELF : *comm, rows, solver_) == 0;
    if (!is_made) reason = take_error();
    return is_made;
  }
  bool solve(const double* b, double* x, const BuckensGridLimits& limits,
             BuckensGridOutcome& outcome, std::string& reason) override {
    const KeptErrors errors;
    const bool is_solved = buckens_petsc::solve(solver_, b, x, limits, outcome) == 0;
    if (!is_solved) reason = take_error();
    return is_solved;
  }
  double bytes() const override {
    const KeptErrors errors;
    return bytes_of(solver_);
  }
  bool is_direct() const override { return solver_.is_direct; }

 private:
  Solver solver_;
};

LoadedSolver* make(const MPI_Comm* comm, const Rows& rows, std::string& reason) {
  auto solver = std::make_unique<SolverOfPetsc>();
  return solver->make(comm, rows, reason) ? solver.release() : nullptr;
}

ModeSearch find_modes(MPI_Comm comm, const ModeProblem& problem, std::string& reason) {
  ModeSearch out;
  const KeptErrors errors;
  const PetscErrorCode failure = search_modes(comm, problem, out);
  if (failure == 0 || out.end == ModeSearch::End::solve_failed) return out;
  out.end = failure == PETSC_ERR_MEM ? ModeSearch::End::out_of_memory : ModeSearch::End::error;
  reason = take_error();
  return out;
}

const SolverLibrary library = {make, find_modes, end_petsc};

}  // namespace

}  // namespace buckens_petsc

extern "C" __attribute__((visibility("default"))) const buckens_petsc::SolverLibrary*
buckens_petsc_solvers() {
  return &buckens_petsc::library;
}
