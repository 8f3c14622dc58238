// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::body {

/// Elastic vibrations of a free body, lowest first.
struct FreeModes {
  linalg::Vector omega;   ///< angular frequencies ω [rad/s], ascending
  linalg::Matrix shapes;  ///< n×count, M-orthonormal, M-orthogonal to the rigid modes
};

/// Solves (K − ω²M) d = 0 with Pᵀd = 0, P = MΦ, FM (27); rigid motion never appears.
///
/// Up to 600 DOF: dense, on an orthonormal basis of {d : Pᵀd = 0}. Above: simultaneous inverse
/// iteration on Y (K + μM)⁻¹M, FM (31), two to four sparse factorisations; free_free_modes(), which
/// knows the mesh, usually needs one. Theory: docs/theory/04-free-vibration.md.
/// @param M positive definite on {d : Pᵀd = 0}, n×n
/// @param Phi rigid modes, n×r; zero and dependent columns allowed
/// @param count modes wanted; fewer are returned if the body has fewer
/// @throws NumericalError if the iteration does not converge or M is not positive definite
/// @throws ModelError if a third of all modes of more than 4000 DOF is requested
FreeModes free_modes(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K,
                     const linalg::Matrix& Phi, int count);

/// Whether the dense method is faster: up to 600 DOF, or if many modes are wanted.
bool is_dense_better(Eigen::Index num_dofs, Eigen::Index count);

}  // namespace buckens::body
