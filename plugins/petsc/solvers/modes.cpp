// SPDX-License-Identifier: Apache-2.0
// Modes by SLEPc: the Krylov–Schur method on Y A⁻¹YᵀM, where Y = 1 − ΦPᵀ with P = MΦ removes rigid
// motions. It is symmetric in the inner product xᵀA y.
#include "modes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <petscblaslapack.h>
#include <slepceps.h>

#include "mode_search.h"
#include "solver.h"

namespace buckens_petsc {

namespace {

constexpr int kMostRestarts = 500;
// Each search after the first one looks for so many pairs, in a basis of so many vectors.
constexpr int kWantedAgain = 4, kBasisAgain = 20;
// θ that differ by less than this are those of one frequency.
constexpr double kSame = 1e-10;

/// @param residual ‖A⁻¹M x − θ x‖ in the norm of A, in which x has the length 1. In that of M the
/// residual is at most √θ₁ times as long, and x has the length √θ.
PetscErrorCode judge(EPS, PetscScalar theta, PetscScalar, PetscReal residual, PetscReal* error,
                     void* context) {
  auto& search = *static_cast<Search*>(context);
  PetscFunctionBeginUser;
  search.largest = std::max(search.largest, theta);
  const bool is_positive = theta > 0;
  *error = is_positive ? residual / theta * std::sqrt(search.largest / theta) : 1.0;
  if (*error >= search.problem->tolerance) search.left = theta + residual;
  PetscFunctionReturn(0);
}

PetscErrorCode decide(EPS eps, PetscInt restarts, PetscInt most_restarts, PetscInt converged,
                      PetscInt wanted, EPSConvergedReason* verdict, void* context) {
  const auto& search = *static_cast<Search*>(context);
  PetscFunctionBeginUser;
  PetscCall(EPSStoppingBasic(eps, restarts, most_restarts, converged, wanted, verdict, nullptr));
  if (*verdict == EPS_CONVERGED_ITERATING && search.left < search.least_missing) {
    *verdict = EPS_CONVERGED_USER;
  }
  PetscFunctionReturn(0);
}

/// Numbers in (−1, 1) that depend on the row and the search, not on the number of processes.
PetscErrorCode scatter(const ModeProblem& problem, unsigned search, Vec x) {
  PetscScalar* values = nullptr;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(x, &values));
  for (int k = 0; k < problem.count; ++k) {
    std::uint64_t bits = (static_cast<std::uint64_t>(search) << 32U) + problem.first + k + 1;
    for (const std::uint64_t factor : {0xbf58476d1ce4e5b9U, 0x94d049bb133111ebU}) {
      bits = (bits ^ (bits >> 30U)) * factor;
    }
    values[k] = 2.0 * (static_cast<double>(bits >> 11U) * 0x1p-53) - 1.0;
  }
  PetscCall(VecRestoreArrayWrite(x, &values));
  PetscFunctionReturn(0);
}

PetscErrorCode set_up(Search& search, EPS eps, int wanted, int basis) {
  ST transformation = nullptr;
  KSP solver = nullptr;
  PC preconditioner = nullptr;
  PetscFunctionBeginUser;
  PetscCall(EPSSetOperators(eps, search.sieved_mass, search.inner));
  PetscCall(EPSSetProblemType(eps, EPS_GHEP));
  PetscCall(EPSSetType(eps, EPSKRYLOVSCHUR));
  PetscCall(EPSSetWhichEigenpairs(eps, EPS_LARGEST_REAL));
  PetscCall(EPSSetDimensions(eps, wanted, basis, PETSC_DEFAULT));
  PetscCall(EPSSetTolerances(eps, search.problem->tolerance, kMostRestarts));
  PetscCall(EPSSetPurify(eps, PETSC_FALSE));  // A is regular
  PetscCall(EPSSetConvergenceTestFunction(eps, judge, &search, nullptr));
  PetscCall(EPSSetStoppingTestFunction(eps, decide, &search, nullptr));
  PetscCall(EPSGetST(eps, &transformation));
  PetscCall(STGetKSP(transformation, &solver));
  PetscCall(KSPSetType(solver, KSPPREONLY));
  PetscCall(KSPGetPC(solver, &preconditioner));
  PetscCall(PCSetType(preconditioner, PCSHELL));
  PetscCall(PCShellSetContext(preconditioner, &search));
  PetscCall(PCShellSetApply(preconditioner, solve_sieved));
  PetscFunctionReturn(0);
}

/// Takes what a search has found, in the order of θ. @param least of θ
PetscErrorCode insert(Search& search, EPS eps, double least, int* inserted) {
  PetscInt converged = 0;
  PetscFunctionBeginUser;
  *inserted = 0;
  PetscCall(EPSGetConverged(eps, &converged));
  for (PetscInt k = 0; k < converged; ++k) {
    PetscScalar theta = 0;
    PetscCall(EPSGetEigenvalue(eps, k, &theta, nullptr));
    if (theta <= least) break;
    Vec shape = nullptr;
    PetscCall(MatCreateVecs(search.mass, &shape, nullptr));
    const auto at = std::upper_bound(search.theta.begin(), search.theta.end(), theta,
                                     [](double a, double b) { return a > b; });
    search.shapes.insert(search.shapes.begin() + (at - search.theta.begin()), shape);
    search.theta.insert(at, theta);
    PetscCall(EPSGetEigenvector(eps, k, shape, nullptr));
    ++*inserted;
  }
  PetscFunctionReturn(0);
}

/// One search, for pairs that are not found yet. @param least of θ of those that are wanted
PetscErrorCode run(Search& search, int number, int wanted, int basis, double least, int* inserted) {
  EPS eps = nullptr;
  Vec start = nullptr;
  PetscInt restarts = 0;
  EPSConvergedReason verdict = EPS_CONVERGED_ITERATING;
  PetscFunctionBeginUser;
  search.left = PETSC_MAX_REAL;
  search.least_missing = least;
  PetscCall(EPSCreate(search.comm, &eps));
  PetscCall(set_up(search, eps, wanted, basis));
  PetscCall(MatCreateVecs(search.mass, &start, nullptr));
  PetscCall(scatter(*search.problem, static_cast<unsigned>(number), start));
  PetscCall(EPSSetInitialSpace(eps, 1, &start));
  PetscCall(VecDestroy(&start));
  PetscCall(
      EPSSetDeflationSpace(eps, static_cast<PetscInt>(search.shapes.size()), search.shapes.data()));
  PetscCall(EPSSolve(eps));
  PetscCall(EPSGetIterationNumber(eps, &restarts));
  PetscCall(EPSGetConvergedReason(eps, &verdict));
  search.out->restarts += static_cast<int>(restarts);
  PetscCall(insert(search, eps, least, inserted));
  if (verdict < 0) search.out->end = ModeSearch::End::unconverged;
  PetscCall(EPSDestroy(&eps));
  PetscFunctionReturn(0);
}

/// All searches: a Krylov space has one vector for each frequency, so rounding alone brings further
/// modes of a multiple one. Others are found if those that are known are left out.
PetscErrorCode search_all(Search& search) {
  const auto wanted = static_cast<std::size_t>(search.problem->wanted);
  int inserted = 0;
  PetscFunctionBeginUser;
  PetscCall(run(search, 0, search.problem->wanted, search.problem->basis, 0.0, &inserted));
  for (int number = 1; search.out->end == ModeSearch::End::converged && inserted > 0; ++number) {
    const double least = search.theta[std::min(wanted, search.theta.size()) - 1] * (1.0 + kSame);
    PetscCall(run(search, number, kWantedAgain, kBasisAgain, least, &inserted));
  }
  PetscFunctionReturn(0);
}

/// Shapes are orthogonal in A to rounding, in M to the error of the shapes: so they are mixed until
/// they are in M, too, which makes them and θ as good as their space allows.
PetscErrorCode orthogonalise(Search& search, std::vector<double>& mixing) {
  const auto count = static_cast<PetscBLASInt>(search.shapes.size());
  const auto n = static_cast<std::size_t>(count);
  PetscBLASInt info = 0;
  const auto room = static_cast<PetscBLASInt>(8 * n);
  std::vector<double> work(8 * n);
  Vec product = nullptr;
  PetscFunctionBeginUser;
  if (n == 0) PetscFunctionReturn(0);
  mixing.resize(n * n);
  PetscCall(MatCreateVecs(search.mass, &product, nullptr));
  for (std::size_t k = 0; k < n; ++k) {
    PetscCall(MatMult(search.mass, search.shapes[k], product));
    PetscCall(VecMDot(product, count, search.shapes.data(), mixing.data() + k * n));
  }
  PetscCall(VecDestroy(&product));
  LAPACKsyev_("V", "L", &count, mixing.data(), &count, search.theta.data(), work.data(), &room,
              &info);
  PetscCheck(info == 0, search.comm, PETSC_ERR_LIB, "the modes cannot be orthogonalised");
  PetscFunctionReturn(0);
}

PetscErrorCode give(Search& search) {
  const ModeProblem& problem = *search.problem;
  const std::size_t n = search.shapes.size();
  std::vector<double> mixing;
  Vec shape = nullptr;
  PetscFunctionBeginUser;
  for (Vec& each : search.shapes) {
    PetscScalar* values = nullptr;
    PetscCall(VecGetArray(each, &values));
    search.remove(problem.motions, search.inertia.data(), values);
    PetscCall(VecRestoreArray(each, &values));
  }
  PetscCall(orthogonalise(search, mixing));
  PetscCall(MatCreateVecs(search.mass, &shape, nullptr));
  search.out->found = std::min(problem.wanted, static_cast<int>(n));
  for (int k = 0; k < search.out->found; ++k) {
    const std::size_t column = n - 1 - static_cast<std::size_t>(k);  // the largest is the last
    const double theta = search.theta[column];
    const PetscScalar* values = nullptr;
    PetscCall(VecSet(shape, 0.0));
    PetscCall(VecMAXPY(shape, static_cast<PetscInt>(n), mixing.data() + column * n,
                       search.shapes.data()));
    PetscCall(VecScale(shape, 1.0 / std::sqrt(theta)));
    PetscCall(VecGetArrayRead(shape, &values));
    problem.take(k, theta, values);
    PetscCall(VecRestoreArrayRead(shape, &values));
  }
  PetscCall(VecDestroy(&shape));
  PetscFunctionReturn(0);
}

}  // namespace

PetscErrorCode search_modes(MPI_Comm comm, const ModeProblem& problem, ModeSearch& out) {
  PetscFunctionBeginUser;
  PetscCall(start_slepc());
  Search search;
  search.comm = comm;
  search.problem = &problem;
  search.out = &out;
  PetscCall(prepare(search));
  PetscCall(search_all(search));
  if (out.end == ModeSearch::End::converged) PetscCall(give(search));
  PetscFunctionReturn(0);
}

}  // namespace buckens_petsc
