// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/base/usable_memory.h"
#include "buckens/body/body.h"
#include "buckens/linalg/factor.h"
#include "buckens/linalg/matrix_sum.h"

namespace buckens::body {

/// What the choice of a solver comes to for one matrix.
struct SolverDecision {
  bool iterates = false;
  std::string why;  ///< of an automatic choice, else empty
};

/// Automatic: by a factor if its predicted memory is usable, or if there is no iterative solver.
/// @param A the matrix, or one with its pattern; formed whole only where that has to be known
/// @param memory that the factor may take [bytes]
SolverDecision decide_solver(const SolverChoice& choice, const linalg::MatrixSum& A,
                             double memory = base::usable_memory());

/// Solves by iteration, with the rigid motions of the body as those of little energy.
/// @param A positive definite, of the variables of the body
/// @throws IoError if there is no iterative solver
/// @throws NumericalError if it cannot be made, as with unknown options of PETSc
std::shared_ptr<const linalg::Factor> make_iterative(const FlexiblePart& part,
                                                     const linalg::MatrixSum& A);

/// Makes factors, or what takes their place, as chosen for the body, which must outlive it.
linalg::MakeFactor solver_of(const FlexiblePart& part);

/// Variables of a node, if all nodes have as many and they are numbered node by node; else 1.
int variables_per_node(const fem::DofMap& dofs, Eigen::Index size);

}  // namespace buckens::body
