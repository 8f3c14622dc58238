// SPDX-License-Identifier: Apache-2.0
// Conjugate gradients with PETSc's smoothed-aggregation multigrid (GAMG), or what options of PETSc
// say: MUMPS, hypre, …
#include "solver.h"

#include <cmath>
#include <cstring>
#include <vector>

#include "options.h"

namespace buckens_petsc {

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

PetscErrorCode set_motions(const Rows& rows, Mat matrix) {
  PetscFunctionBeginUser;
  if (rows.num_motions == 0) PetscFunctionReturn(0);
  Vec motions[6] = {};
  const int count = rows.num_motions < 6 ? rows.num_motions : 6;
  for (int k = 0; k < count; ++k) {
    PetscCall(MatCreateVecs(matrix, &motions[k], nullptr));
    PetscScalar* values = nullptr;
    PetscCall(VecGetArrayWrite(motions[k], &values));
    if (rows.count > 0) {
      std::memcpy(values, rows.motions + static_cast<std::size_t>(k) * rows.stride,
                  static_cast<std::size_t>(rows.count) * sizeof(double));
    }
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
  PetscCall(MatNullSpaceCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), PETSC_FALSE,
                               count, motions, &space));
  PetscCall(MatSetNearNullSpace(matrix, space));
  PetscCall(MatNullSpaceDestroy(&space));
  for (int k = 0; k < count; ++k) PetscCall(VecDestroy(&motions[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode take_matrix(MPI_Comm comm, const Rows& rows, Mat* matrix) {
  int processes = 1;
  PetscFunctionBeginUser;
  MPI_Comm_size(comm, &processes);
  if (processes == 1) {
    // Columns of a symmetric matrix are its rows; PETSc does not write into them.
    PetscCall(MatCreateSeqAIJWithArrays(comm, rows.size, rows.size, const_cast<int*>(rows.starts),
                                        const_cast<int*>(rows.columns),
                                        const_cast<double*>(rows.values), matrix));
  } else {
    PetscCall(MatCreateMPIAIJWithArrays(comm, rows.count, rows.count, rows.size, rows.size,
                                        rows.starts, rows.columns, rows.values, matrix));
  }
  PetscCall(MatSetBlockSize(*matrix, rows.block));
  PetscCall(MatSetOption(*matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(MatSetOption(*matrix, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/// What is applied once, without iterating, has to solve: a preconditioner would give an answer,
/// too, but not that of the equations.
PetscErrorCode require_solution(Solver& solver) {
  // Relative to the equations, however badly conditioned they are. Of factors it is 1e-16.
  constexpr double kMostResidual = 1e-11;
  PetscInt first = 0, end = 0;
  PetscScalar* values = nullptr;
  PetscReal size = 0, left = 0, of_matrix = 0, of_x = 0;
  Vec residual = nullptr;
  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(solver.b, &first, &end));
  PetscCall(VecGetArrayWrite(solver.b, &values));
  // All frequencies, neither smooth nor the same in any two variables.
  for (PetscInt k = first; k < end; ++k) values[k - first] = std::sin(1.0 + 2.39996 * k);
  PetscCall(VecRestoreArrayWrite(solver.b, &values));
  PetscCall(KSPSolve(solver.iteration, solver.b, solver.x));
  PetscCall(VecDuplicate(solver.b, &residual));
  PetscCall(MatMult(solver.matrix, solver.x, residual));
  PetscCall(VecAXPY(residual, -1.0, solver.b));
  PetscCall(VecNorm(residual, NORM_2, &left));
  PetscCall(VecNorm(solver.b, NORM_2, &size));
  PetscCall(VecNorm(solver.x, NORM_2, &of_x));
  PetscCall(MatNorm(solver.matrix, NORM_INFINITY, &of_matrix));
  PetscCall(VecDestroy(&residual));
  if (left <= kMostResidual * (size + of_matrix * of_x)) PetscFunctionReturn(0);
  reason =
      "-ksp_type preonly applies a preconditioner once, and this one does not solve the equations; "
      "leave it out to iterate, or take a factor (-pc_type cholesky)";
  PetscFunctionReturn(PETSC_ERR_USER_INPUT);
}

/// The iteration ends by an error in the energy norm.
PetscErrorCode require_energy_norm(const Solver& solver) {
  KSPNormType norm = KSP_NORM_NATURAL;
  PetscFunctionBeginUser;
  PetscCall(KSPGetNormType(solver.iteration, &norm));
  if (norm == KSP_NORM_NATURAL) PetscFunctionReturn(0);
  reason = "the error is judged in the energy norm; leave out -ksp_norm_type";
  PetscFunctionReturn(PETSC_ERR_USER_INPUT);
}

/// A factor needs the matrix no more.
PetscErrorCode keep_factor_only(Solver& solver) {
  PC preconditioner = nullptr;
  PetscBool has_factor = PETSC_FALSE;
  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(solver.iteration, &preconditioner));
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(preconditioner), &has_factor,
                                      PCCHOLESKY, PCLU, ""));
  if (has_factor == PETSC_FALSE) PetscFunctionReturn(0);
  PetscCall(PCFactorGetMatrix(preconditioner, &solver.factor));
  PetscCall(PetscObjectReference(reinterpret_cast<PetscObject>(solver.factor)));
  PetscCall(KSPDestroy(&solver.iteration));
  PetscCall(MatDestroy(&solver.matrix));
  PetscFunctionReturn(0);
}

PetscErrorCode set_up(MPI_Comm comm, Solver& solver) {
  PC preconditioner = nullptr;
  PCFailedReason failure = PC_NOERROR;
  PetscBool is_direct = PETSC_FALSE;
  PetscFunctionBeginUser;
  PetscCall(KSPCreate(comm, &solver.iteration));
  PetscCall(KSPSetOperators(solver.iteration, solver.matrix, solver.matrix));
  PetscCall(KSPSetType(solver.iteration, KSPCG));
  PetscCall(KSPSetNormType(solver.iteration, KSP_NORM_NATURAL));
  PetscCall(KSPGetPC(solver.iteration, &preconditioner));
  PetscCall(PCSetType(preconditioner, PCGAMG));
  PetscCall(KSPSetFromOptions(solver.iteration));
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(solver.iteration), KSPPREONLY,
                                   &is_direct));
  solver.is_direct = is_direct == PETSC_TRUE;
  if (solver.is_direct) {
    PetscCall(KSPSetNormType(solver.iteration, KSP_NORM_NONE));
  } else {
    PetscCall(KSPSetInitialGuessNonzero(solver.iteration, PETSC_TRUE));
    PetscCall(KSPSetConvergenceTest(solver.iteration, has_converged, &solver, nullptr));
    PetscCall(require_energy_norm(solver));
  }
  PetscCall(KSPSetUp(solver.iteration));
  PetscCall(KSPSetUpOnBlocks(solver.iteration));
  PetscCall(PCGetFailedReason(preconditioner, &failure));
  if (failure == PC_NOERROR) {
    if (!solver.is_direct) PetscFunctionReturn(0);
    PetscCall(require_solution(solver));
    PetscCall(keep_factor_only(solver));
    PetscFunctionReturn(0);
  }
  reason = failure == PC_FACTOR_OUTMEMORY
               ? "there is too little memory for the factor"
               : "its factor cannot be computed: the matrix is not positive definite";
  PetscFunctionReturn(PETSC_ERR_MAT_LU_ZRPVT);
}

PetscErrorCode make(MPI_Comm comm, const Rows& rows, Solver& solver) {
  PetscFunctionBeginUser;
  PetscCall(take_matrix(comm, rows, &solver.matrix));
  PetscCall(set_motions(rows, solver.matrix));
  rows.release();
  PetscCall(MatCreateVecs(solver.matrix, &solver.x, &solver.b));
  PetscCall(set_up(comm, solver));
  PetscFunctionReturn(0);
}

}  // namespace

Solver::~Solver() {
  (void)KSPDestroy(&iteration);
  (void)MatDestroy(&factor);
  (void)VecDestroy(&b);
  (void)VecDestroy(&x);
  (void)MatDestroy(&matrix);
  (void)PetscOptionsDestroy(&options);
}

PetscErrorCode make_solver(MPI_Comm comm, const Rows& rows, Solver& solver) {
  PetscFunctionBeginUser;
  PetscCall(refuse_words(rows.options));
  PetscCall(PetscOptionsCreate(&solver.options));
  PetscCall(set_options(rows.options, solver.options));
  PetscCall(refuse_ends(solver.options));
  // In place of those of the process.
  PetscCall(PetscOptionsPush(solver.options));
  const PetscErrorCode failure = make(comm, rows, solver);
  PetscCall(PetscOptionsPop());
  if (failure != 0) PetscFunctionReturn(failure);
  PetscCall(refuse_unknown(rows.options, solver.options));
  PetscFunctionReturn(0);
}

PetscErrorCode solve(Solver& solver, const double* b, double* x, const BuckensGridLimits& limits,
                     BuckensGridOutcome& outcome) {
  PetscFunctionBeginUser;
  solver.limits = limits;
  solver.first = solver.last = 0;
  if (solver.factor != nullptr) {
    PetscCall(VecPlaceArray(solver.b, b));
    PetscCall(VecPlaceArray(solver.x, x));
    PetscCall(MatSolve(solver.factor, solver.b, solver.x));
    PetscCall(VecResetArray(solver.b));
    PetscCall(VecResetArray(solver.x));
    outcome = {1, 0, 0, 1};
    PetscFunctionReturn(0);
  }
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

double bytes_of(const Solver& solver) {
  PC preconditioner = nullptr;
  PetscBool is_grid = PETSC_FALSE;
  MatInfo info;
  if (solver.factor != nullptr) {
    return MatGetInfo(solver.factor, MAT_GLOBAL_SUM, &info) == 0 ? info.nz_used * 8.0 : 0;
  }
  if (KSPGetPC(solver.iteration, &preconditioner) != 0) return 0;
  (void)PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(preconditioner), &is_grid, PCMG,
                                  PCGAMG, "");
  if (is_grid == PETSC_TRUE) {
    PetscReal operators = 1;
    PetscReal grids = 1;
    if (PCMGGetGridComplexity(preconditioner, &grids, &operators) != 0) return 0;
    if (MatGetInfo(solver.matrix, MAT_GLOBAL_SUM, &info) != 0) return 0;
    return (operators - 1) * info.nz_used * 12.0;
  }
  return 0;
}

KeptErrors::KeptErrors() {
  reason.clear();
  (void)PetscPushErrorHandler(note_error, nullptr);
}
KeptErrors::~KeptErrors() { (void)PetscPopErrorHandler(); }

std::string take_error() {
  std::string out = reason.empty() ? "unknown error of PETSc" : reason;
  reason.clear();
  return out;
}

void set_error(const std::string& text) { reason = text; }

}  // namespace buckens_petsc
