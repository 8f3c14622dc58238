// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::linalg {

/// Solves A x = b by Jacobi-preconditioned conjugate gradients, without factorising A.
///
/// Meant for mass matrices, whose scaled condition number is small for any mesh. Rows with a
/// zero diagonal (massless DOF) are left out: x = 0 there.
/// @param A symmetric positive semidefinite
/// @throws NumericalError if b is not finite, or if the residual does not fall below
/// 1e-14 |b| (or stagnate at rounding) within 50 + 20 √n + n iterations, at most 20
/// 000
Vector conjugate_gradients(const SparseMatrix& A, const Vector& b);
/// The same of a matrix that may be divided among processes.
Vector conjugate_gradients(const SymmetricMatrix& A, const Vector& b);

}  // namespace buckens::linalg
