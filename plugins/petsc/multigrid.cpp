// SPDX-License-Identifier: Apache-2.0
// Conjugate gradients with PETSc's smoothed-aggregation multigrid (GAMG), as a plug-in.
//
// PETSc brings MPI and libraries under the GPL into the process: so it is loaded by those runs only
// that ask for it, and nothing else links it.
#include <cstdio>
#include <cstring>
#include <string>

#include <petscksp.h>

#include "buckens/linalg/grid_plugin.h"

namespace {

std::string reason;  // of the last error; one thread calls at a time

PetscErrorCode note_error(MPI_Comm /*comm*/, int line, const char* function, const char* /*file*/,
                          PetscErrorCode code, PetscErrorType type, const char* text,
                          void* /*context*/) {
  if (type == PETSC_ERROR_INITIAL) {
    reason = std::string(function == nullptr ? "PETSc" : function) + ", line " +
             std::to_string(line) + ": " + (text == nullptr ? "error" : text);
  }
  return code;
}

int fail(char* error, int size) {
  std::snprintf(error, static_cast<std::size_t>(size), "%s",
                reason.empty() ? "unknown error of PETSc" : reason.c_str());
  reason.clear();
  return 1;
}

PetscErrorCode start() {
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

struct Solver {
  Mat matrix = nullptr;
  KSP iteration = nullptr;
  Vec b = nullptr, x = nullptr;
  BuckensGridLimits limits{};
  double first = 0, last = 0;

  ~Solver() {
    (void)KSPDestroy(&iteration);
    (void)VecDestroy(&b);
    (void)VecDestroy(&x);
    (void)MatDestroy(&matrix);
  }
};

PetscErrorCode has_converged(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason* verdict,
                             void* context) {
  auto& solver = *static_cast<Solver*>(context);
  PetscFunctionBeginUser;
  *verdict = KSP_CONVERGED_ITERATING;
  if (iteration == 0) solver.first = norm;
  solver.last = norm;
  const double limit =
      PetscMin(PetscMax(solver.limits.absolute, solver.limits.least * solver.first),
               solver.limits.most * solver.first);
  if (PetscIsInfOrNanReal(norm)) {
    *verdict = KSP_DIVERGED_NANORINF;
  } else if (norm <= limit) {
    *verdict = KSP_CONVERGED_RTOL;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode set_options() {
  PetscFunctionBeginUser;
  const char* const values[][2] = {
      {"-buckens_pc_gamg_type", "agg"},
      {"-buckens_pc_gamg_agg_nsmooths", "1"},
      {"-buckens_pc_gamg_threshold", "0.0"},
      {"-buckens_pc_gamg_coarse_eq_limit", "1000"},
      {"-buckens_mg_levels_ksp_type", "chebyshev"},
      {"-buckens_mg_levels_ksp_max_it", "2"},
      {"-buckens_mg_levels_pc_type", "jacobi"},
      {"-buckens_mg_levels_esteig_ksp_type", "cg"},
      {"-buckens_mg_levels_esteig_ksp_max_it", "10"},
  };
  for (const auto& option : values) PetscCall(PetscOptionsSetValue(nullptr, option[0], option[1]));
  PetscFunctionReturn(0);
}

PetscErrorCode set_motions(const BuckensGridMatrix& from, Mat matrix) {
  PetscFunctionBeginUser;
  if (from.num_motions == 0) PetscFunctionReturn(0);
  Vec motions[6] = {};
  const int count = from.num_motions < 6 ? from.num_motions : 6;
  for (int k = 0; k < count; ++k) {
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, from.size, &motions[k]));
    PetscScalar* values = nullptr;
    PetscCall(VecGetArrayWrite(motions[k], &values));
    std::memcpy(values, from.motions + static_cast<std::size_t>(k) * from.size,
                static_cast<std::size_t>(from.size) * sizeof(double));
    PetscCall(VecRestoreArrayWrite(motions[k], &values));
  }
  for (int k = 0; k < count; ++k) {  // orthonormal, as PETSc asks
    for (int twice = 0; twice < 2; ++twice) {
      for (int other = 0; other < k; ++other) {
        PetscScalar product = 0;
        PetscCall(VecDot(motions[k], motions[other], &product));
        PetscCall(VecAXPY(motions[k], -product, motions[other]));
      }
    }
    PetscCall(VecNormalize(motions[k], nullptr));
  }
  MatNullSpace space = nullptr;
  PetscCall(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, count, motions, &space));
  PetscCall(MatSetNearNullSpace(matrix, space));
  PetscCall(MatNullSpaceDestroy(&space));
  for (int k = 0; k < count; ++k) PetscCall(VecDestroy(&motions[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode make(const BuckensGridMatrix& from, Solver& solver) {
  PetscFunctionBeginUser;
  // Columns of a symmetric matrix are its rows; PETSc does not write into them.
  PetscCall(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, from.size, from.size,
                                      const_cast<int*>(from.starts), const_cast<int*>(from.rows),
                                      const_cast<double*>(from.values), &solver.matrix));
  PetscCall(MatSetBlockSize(solver.matrix, from.block));
  PetscCall(MatSetOption(solver.matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(MatSetOption(solver.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(set_motions(from, solver.matrix));
  PetscCall(MatCreateVecs(solver.matrix, &solver.x, &solver.b));
  PetscCall(set_options());
  PetscCall(KSPCreate(PETSC_COMM_SELF, &solver.iteration));
  PetscCall(KSPSetOptionsPrefix(solver.iteration, "buckens_"));
  PetscCall(KSPSetOperators(solver.iteration, solver.matrix, solver.matrix));
  PetscCall(KSPSetType(solver.iteration, KSPCG));
  PetscCall(KSPSetNormType(solver.iteration, KSP_NORM_NATURAL));
  PC preconditioner = nullptr;
  PetscCall(KSPGetPC(solver.iteration, &preconditioner));
  PetscCall(PCSetType(preconditioner, PCGAMG));
  PetscCall(KSPSetFromOptions(solver.iteration));
  PetscCall(KSPSetInitialGuessNonzero(solver.iteration, PETSC_TRUE));
  PetscCall(KSPSetConvergenceTest(solver.iteration, has_converged, &solver, nullptr));
  PetscCall(KSPSetUp(solver.iteration));
  PetscFunctionReturn(0);
}

PetscErrorCode solve(Solver& solver, const double* b, double* x, const BuckensGridLimits& limits,
                     BuckensGridOutcome& outcome) {
  PetscFunctionBeginUser;
  solver.limits = limits;
  solver.first = solver.last = 0;
  PetscCall(KSPSetTolerances(solver.iteration, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT,
                             limits.most_iterations));
  PetscCall(VecPlaceArray(solver.b, b));
  PetscCall(VecPlaceArray(solver.x, x));
  PetscCall(KSPSolve(solver.iteration, solver.b, solver.x));
  PetscCall(VecResetArray(solver.b));
  PetscCall(VecResetArray(solver.x));
  KSPConvergedReason verdict = KSP_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  PetscCall(KSPGetConvergedReason(solver.iteration, &verdict));
  PetscCall(KSPGetIterationNumber(solver.iteration, &iterations));
  outcome = {static_cast<int>(iterations), solver.first, solver.last, verdict > 0 ? 1 : 0};
  PetscFunctionReturn(0);
}

/// About: entries of all levels below the finest, which is the caller's.
double bytes_of(Solver& solver) {
  PC preconditioner = nullptr;
  PetscReal operators = 1;
  PetscReal grids = 1;
  MatInfo info;
  if (KSPGetPC(solver.iteration, &preconditioner) != 0) return 0;
  if (PCMGGetGridComplexity(preconditioner, &grids, &operators) != 0) return 0;
  if (MatGetInfo(solver.matrix, MAT_LOCAL, &info) != 0) return 0;
  return (operators - 1) * info.nz_used * 12.0;
}

const char* plugin_name() {
  static char text[64];
  std::snprintf(text, sizeof text, "PETSc %d.%d.%d", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR,
                PETSC_VERSION_SUBMINOR);
  return text;
}

void* plugin_make(const BuckensGridMatrix* matrix, char* error, int error_size) {
  reason.clear();
  if (start() != 0) {
    fail(error, error_size);
    return nullptr;
  }
  (void)PetscPushErrorHandler(note_error, nullptr);
  auto* solver = new Solver;
  const bool is_made = make(*matrix, *solver) == 0;
  (void)PetscPopErrorHandler();
  if (is_made) return solver;
  fail(error, error_size);
  delete solver;
  return nullptr;
}

int plugin_solve(void* solver, const double* b, double* x, const BuckensGridLimits* limits,
                 BuckensGridOutcome* outcome, char* error, int error_size) {
  (void)PetscPushErrorHandler(note_error, nullptr);
  const bool is_solved = solve(*static_cast<Solver*>(solver), b, x, *limits, *outcome) == 0;
  (void)PetscPopErrorHandler();
  return is_solved ? 0 : fail(error, error_size);
}

double plugin_bytes(void* solver) { return bytes_of(*static_cast<Solver*>(solver)); }

void plugin_release(void* solver) { delete static_cast<Solver*>(solver); }

const BuckensGridPlugin plugin = {kBuckensGridVersion, plugin_name,  plugin_make,
                                  plugin_solve,        plugin_bytes, plugin_release};

}  // namespace

extern "C" __attribute__((visibility("default"))) const BuckensGridPlugin* buckens_grid_plugin() {
  return &plugin;
}
