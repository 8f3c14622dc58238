// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/free_modes.h"
#include "buckens/body/sieve.h"

namespace buckens::body {

/// All elastic modes of a small body by a dense eigenproblem on an orthonormal basis of
/// {d : Pᵀd = 0}. Variables without mass are allowed; they have no modes.
/// @throws NumericalError if a motion has neither mass nor stiffness
FreeModes dense_free_modes(const linalg::SparseMatrix& M, const linalg::SparseMatrix& K,
                           const linalg::Matrix& Phi, const Sieve& sieve);

/// 1/√M_ii, which brings metres and radians to one scale; massless variables by their stiffness.
linalg::Vector variable_scale(const linalg::SparseMatrix& M, const linalg::SparseMatrix& K);

}  // namespace buckens::body
