// SPDX-License-Identifier: Apache-2.0
// Beginning and end of PETSc and SLEPc in a process.
#include <slepcsys.h>

#include "solver.h"

namespace buckens_petsc {

PetscErrorCode start_petsc() {
  PetscBool is_running = PETSC_FALSE;
  PetscFunctionBeginUser;
  PetscCall(PetscInitialized(&is_running));
  if (!is_running) {
    // Interrupts and crashes are the program's business, not PETSc's.
    PetscCall(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr));
    PetscCall(PetscInitializeNoArguments());
  }
  PetscFunctionReturn(0);
}

PetscErrorCode start_slepc() {
  PetscFunctionBeginUser;
  PetscCall(start_petsc());
  PetscCall(SlepcInitializeNoArguments());  // which does nothing the second time
  PetscFunctionReturn(0);
}

void end_petsc() {
  PetscBool is_running = PETSC_FALSE;
  if (SlepcInitialized(&is_running) == 0 && is_running == PETSC_TRUE) (void)SlepcFinalize();
  (void)PetscFinalize();
}

}  // namespace buckens_petsc
