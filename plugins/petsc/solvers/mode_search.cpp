// SPDX-License-Identifier: Apache-2.0
// Products and solves of a search for modes, in the shape that SLEPc calls.
#include "mode_search.h"

namespace buckens_petsc {

namespace {

enum class Product { mass, sieved_mass, inner };

/// y = M x, YᵀM x or A x
template <Product of>
PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
  Search* search = nullptr;
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(matrix, &search));
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArrayWrite(y, &to));
  const ModeProblem& problem = *search->problem;
  (of == Product::inner ? problem.multiply_inner : problem.multiply_mass)(from, to);
  if (of == Product::sieved_mass) search->remove(search->inertia.data(), problem.motions, to);
  PetscCall(VecRestoreArrayWrite(y, &to));
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscFunctionReturn(0);
}

}  // namespace

Search::~Search() {
  for (Vec& shape : shapes) (void)VecDestroy(&shape);
  (void)MatDestroy(&mass);
  (void)MatDestroy(&sieved_mass);
  (void)MatDestroy(&inner);
}

void Search::remove(const double* columns, const double* rows, double* F) const {
  const int count = problem->num_motions;
  const int size = problem->count;
  std::vector<double> shares(static_cast<std::size_t>(count), 0.0);
  for (int k = 0; k < count; ++k) {
    const double* row = rows + static_cast<std::size_t>(k) * size;
    for (int i = 0; i < size; ++i) shares[static_cast<std::size_t>(k)] += row[i] * F[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, shares.data(), count, MPI_DOUBLE, MPI_SUM, comm);
  for (int k = 0; k < count; ++k) {
    const double* column = columns + static_cast<std::size_t>(k) * size;
    for (int i = 0; i < size; ++i) F[i] -= column[i] * shares[static_cast<std::size_t>(k)];
  }
}

PetscErrorCode solve_sieved(PC preconditioner, Vec b, Vec x) {
  Search* search = nullptr;
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(preconditioner, &search));
  const ModeProblem& problem = *search->problem;
  PetscCall(VecGetArrayRead(b, &from));
  PetscCall(VecGetArrayWrite(x, &to));
  const bool is_solved = problem.solve(from, to);
  if (is_solved) search->remove(problem.motions, search->inertia.data(), to);
  ++search->out->solves;
  PetscCall(VecRestoreArrayWrite(x, &to));
  PetscCall(VecRestoreArrayRead(b, &from));
  if (is_solved) PetscFunctionReturn(0);
  search->out->end = ModeSearch::End::solve_failed;
  PetscFunctionReturn(PETSC_ERR_LIB);
}

PetscErrorCode prepare(Search& search) {
  const ModeProblem& problem = *search.problem;
  const auto count = static_cast<std::size_t>(problem.count);
  PetscFunctionBeginUser;
  search.inertia.resize(count * static_cast<std::size_t>(problem.num_motions));
  for (int k = 0; k < problem.num_motions; ++k) {
    const std::size_t at = count * static_cast<std::size_t>(k);
    problem.multiply_mass(problem.motions + at, search.inertia.data() + at);
  }
  for (Mat* matrix : {&search.mass, &search.sieved_mass, &search.inner}) {
    PetscCall(MatCreateShell(search.comm, problem.count, problem.count, PETSC_DETERMINE,
                             PETSC_DETERMINE, &search, matrix));
    PetscCall(MatSetOption(*matrix, MAT_SYMMETRIC, PETSC_TRUE));
  }
  PetscCall(MatShellSetOperation(search.mass, MATOP_MULT,
                                 reinterpret_cast<void (*)()>(multiply<Product::mass>)));
  PetscCall(MatShellSetOperation(search.sieved_mass, MATOP_MULT,
                                 reinterpret_cast<void (*)()>(multiply<Product::sieved_mass>)));
  PetscCall(MatShellSetOperation(search.inner, MATOP_MULT,
                                 reinterpret_cast<void (*)()>(multiply<Product::inner>)));
  PetscFunctionReturn(0);
}

}  // namespace buckens_petsc
