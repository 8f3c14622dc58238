// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <petscksp.h>

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

/// OpenBLAS sets memory aside on its first call, and tries for ever if there is none: so before
/// that of libraries whose errors can be told.
void prepare_blas();

/// To the system: what was freed, while MPI keeps the allocator from doing so.
void give_memory_back();

/// While it lives, errors of PETSc are kept instead of printed.
class KeptErrors {
 public:
  KeptErrors();
  ~KeptErrors();
  KeptErrors(const KeptErrors&) = delete;
  KeptErrors& operator=(const KeptErrors&) = delete;
};

/// The last error, which is forgotten by this.
std::string take_reason();
void set_reason(const std::string& text);
/// Writes it, and returns 1.
int fail(char* error, int size);

}  // namespace buckens_petsc
