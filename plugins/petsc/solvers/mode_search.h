// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <petscksp.h>

#include "../solver_library.h"

namespace buckens_petsc {

/// What the functions that SLEPc calls have to know, and what is found so far.
struct Search {
  MPI_Comm comm = MPI_COMM_NULL;
  const ModeProblem* problem = nullptr;
  ModeSearch* out = nullptr;
  std::vector<double> inertia;  // P = MΦ, rows here
  Mat mass = nullptr, sieved_mass = nullptr, inner = nullptr;
  std::vector<Vec> shapes;    // xᵀA x = 1
  std::vector<double> theta;  // of the shapes
  // Of a search that runs:
  double largest = 0;        // θ so far
  double left = 0;           // no pair that has not converged yet, known so far, has a larger θ
  double least_missing = 0;  // it ends if nothing so large is left

  Search() = default;
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
  ~Search();

  /// F ← F − columns · (rowsᵀ F), of rows here.
  void remove(const double* columns, const double* rows, double* F) const;
};

/// Makes the matrices and P.
PetscErrorCode prepare(Search& search);
/// x = Y A⁻¹ b, of a preconditioner whose context is a search.
PetscErrorCode solve_sieved(PC preconditioner, Vec b, Vec x);

}  // namespace buckens_petsc
