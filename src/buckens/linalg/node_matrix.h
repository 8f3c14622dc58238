// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/node_kernels.h"

namespace buckens::linalg {

/// View of a symmetric matrix over nodes. @param A compressed, must outlive the view
NodeMatrix node_matrix(const SparseMatrix& A);

/// The matrix A ⊗ 1 of the variables 3j, 3j + 1, 3j + 2 of each node j, compressed.
SparseMatrix of_variables(const SparseMatrix& A);
/// The number of each node for its three variables.
Vector of_variables(const Vector& of_nodes);

/// y = (A ⊗ 1) x.
void multiply_by_node(const SparseMatrix& A, const double* x, double* y);

}  // namespace buckens::linalg
