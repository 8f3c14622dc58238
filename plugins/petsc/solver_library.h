// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <mpi.h>

#include "buckens/linalg/grid_plugin.h"

namespace buckens_petsc {

/// Rows of a symmetric matrix that one process holds: all of them, or one run of them.
struct Rows {
  int size = 0;   ///< of the whole matrix
  int count = 0;  ///< of the rows here
  const int* starts = nullptr;
  const int* columns = nullptr;
  const double* values = nullptr;
  int block = 1;
  int num_motions = 0;
  const double* motions = nullptr;  ///< of these rows
  int stride = 0;                   ///< from motion to motion
  const char* options = nullptr;    ///< null or empty: none
  /// Called when they have been copied: only several processes copy them.
  std::function<void()> release = [] {};
};

/// A solver for one matrix, on one process or on several that call its functions together.
class LoadedSolver {
 public:
  virtual ~LoadedSolver() = default;
  /// @param b,x of the rows here. @return whether it was possible; otherwise `reason` tells why not
  virtual bool solve(const double* b, double* x, const BuckensGridLimits& limits,
                     BuckensGridOutcome& outcome, std::string& reason) = 0;
  /// About: entries of the levels below the finest, or of the factor, of all processes.
  virtual double bytes() const = 0;
  virtual bool is_direct() const = 0;
};

/// M x = θ A x of vectors of which each process has a run of rows, maybe none. All functions are
/// called by all processes together.
struct ModeProblem {
  int first = 0, count = 0;  ///< rows here
  int wanted = 0;            ///< pairs with the largest θ
  int basis = 0;             ///< most vectors of a search
  double tolerance = 0;      ///< of ‖A⁻¹M x − θ x‖_M / θ
  int num_motions = 0;
  const double* motions = nullptr;  ///< Φ, rows here, one motion after the other; M-orthonormal
  std::function<void(const double* x, double* y)> multiply_mass;   ///< y = M x
  std::function<void(const double* x, double* y)> multiply_inner;  ///< y = A x
  /// x = A⁻¹ b. @return whether it was possible, the same on all processes
  std::function<bool(const double* b, double* x)> solve;
  /// Takes a pair: with θ falling, M-orthonormal, without a share of the motions.
  std::function<void(int number, double theta, const double* x)> take;
};

struct ModeSearch {
  /// After the last two the others may be waiting for this process.
  enum class End {
    converged,
    unconverged,
    solve_failed,
    error,
    out_of_memory
  } end = End::converged;
  int found = 0, restarts = 0;
  long solves = 0;

  bool has_failed() const { return end == End::error || end == End::out_of_memory; }
};

/// What the library of PETSc's solvers exports.
///
/// It is apart since PETSc brings some eighty other libraries along, which take 20 MB of each
/// process: too much for runs that only need MUMPS.
struct SolverLibrary {
  /// Begins PETSc if need be; where several processes share the work, of all together.
  /// @param comm null: this process alone, whose arrays are used in place, else copied
  /// @return null after an error
  LoadedSolver* (*make)(const MPI_Comm* comm, const Rows& rows, std::string& reason);
  /// Finds modes by SLEPc.
  ModeSearch (*find_modes)(MPI_Comm comm, const ModeProblem& problem, std::string& reason);
  /// Ends PETSc if it was begun, before MPI ends.
  void (*end)();
};

/// Loads it. @return null if that fails; then the reason is set
const SolverLibrary* solver_library();
/// Ends PETSc if it was ever loaded.
void end_solver_library();

}  // namespace buckens_petsc
