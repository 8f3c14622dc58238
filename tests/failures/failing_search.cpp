// SPDX-License-Identifier: Apache-2.0
// Loaded before the program (LD_PRELOAD), it makes searches of SLEPc fail in its process, at once.
extern "C" int EPSSolve(void* /*search*/) { return 76; }  // PETSC_ERR_LIB
