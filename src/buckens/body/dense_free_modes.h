// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/free_modes.h"
#include "buckens/body/sieve.h"

namespace buckens::body {

/// All elastic modes of a small body by a dense eigenproblem on an orthonormal basis of
/// {d : Pᵀd = 0}. Massless variables are allowed; they have no modes.
/// @throws NumericalError if a motion has neither mass nor stiffness
FreeModes dense_free_modes(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K,
                           const linalg::Matrix& Phi, const Sieve& sieve);

/// Largest number of variables for which full matrices are formed: two minutes and half a gigabyte.
inline constexpr Eigen::Index kLargestDense = 4000;

/// Refuses so many vibrations of a large body that only full matrices could give them.
/// @throws ModelError stating the largest possible number
void refuse_too_many_modes(Eigen::Index num_dofs, Eigen::Index count);

/// 1/√M_ii, which scales metres and radians alike; massless variables by their stiffness.
linalg::Vector variable_scale(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K);

}  // namespace buckens::body
