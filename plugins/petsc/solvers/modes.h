// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <petscsys.h>

#include "../solver_library.h"

namespace buckens_petsc {

/// Finds the pairs with the largest θ by the Krylov–Schur method of SLEPc, also several with the
/// same θ, as far as searches from other vectors tell.
PetscErrorCode search_modes(MPI_Comm comm, const ModeProblem& problem, ModeSearch& out);

}  // namespace buckens_petsc
