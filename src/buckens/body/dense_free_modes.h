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

/// Largest number of variables for which full matrices are made: two minutes and half a gigabyte.
inline constexpr Eigen::Index kLargestDense = 4000;

/// Refuses vibrations of a large body that are so many that only full matrices would give them.
/// @throws ModelError with a number to ask for
void refuse_too_many_modes(Eigen::Index num_dofs, Eigen::Index count);

/// 1/√M_ii, which brings metres and radians to one scale; massless variables by their stiffness.
linalg::Vector variable_scale(const linalg::SparseMatrix& M, const linalg::SparseMatrix& K);

}  // namespace buckens::body
