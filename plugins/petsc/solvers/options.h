// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <petscsys.h>

namespace buckens_petsc {

/// Those of this plug-in, then the user's, which override them. None of other solvers or of the
/// environment.
PetscErrorCode set_options(const char* of_user, PetscOptions options);

/// PETSc itself passes over words that belong to no option.
PetscErrorCode refuse_words(const char* of_user);

/// What would have no effect, because the program decides where an iteration begins and ends.
PetscErrorCode refuse_ends(PetscOptions options);

/// PETSc itself passes over options that nothing has asked for.
PetscErrorCode refuse_unknown(const char* of_user, PetscOptions options);

}  // namespace buckens_petsc
