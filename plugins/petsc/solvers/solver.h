// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <petscksp.h>

#include "../solver_library.h"

namespace buckens_petsc {

/// A solver of PETSc's for one matrix, on one process or on several that call its functions
/// together.
struct Solver {
  PetscOptions options = nullptr;
  Mat matrix = nullptr;
  KSP iteration = nullptr;
  Mat factor = nullptr;  ///< then there is neither matrix nor iteration
  Vec b = nullptr, x = nullptr;
  BuckensGridLimits limits{};
  double first = 0, last = 0;
  bool is_direct = false;

  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  ~Solver();
};

/// @param rows alone on `comm` their arrays are used in place, else copied
PetscErrorCode make_solver(MPI_Comm comm, const Rows& rows, Solver& solver);
/// @param b,x of the rows here
PetscErrorCode solve(Solver& solver, const double* b, double* x, const BuckensGridLimits& limits,
                     BuckensGridOutcome& outcome);
/// About: entries of the levels below the finest, or of the factor, of all processes.
double bytes_of(const Solver& solver);

/// Begins PETSc in this process, which handles signals itself.
PetscErrorCode start_petsc();
/// Begins SLEPc, and PETSc if need be.
PetscErrorCode start_slepc();
void end_petsc();

/// While it lives, errors of PETSc are kept instead of printed.
class KeptErrors {
 public:
  KeptErrors();
  ~KeptErrors();
  KeptErrors(const KeptErrors&) = delete;
  KeptErrors& operator=(const KeptErrors&) = delete;
};

/// The last error, which is forgotten by this.
std::string take_error();
void set_error(const std::string& text);

}  // namespace buckens_petsc
