// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/inverse_iteration.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::linalg {

/// What eigenpairs of A⁻¹M are asked for, with A = K + μM and its factor divided among processes.
struct DividedPencil {
  const SymmetricMatrix* K = nullptr;  ///< @pre divided, as M is
  const SymmetricMatrix* M = nullptr;
  double shift = 0;                 ///< μ
  const Matrix* motions = nullptr;  ///< rigid ones, M-orthonormal, which are left out
  int count = 0;                    ///< pairs wanted
  double tolerance = 0;             ///< of ‖A⁻¹M x − θ x‖_M / θ
};

/// The pairs with the largest θ by the Krylov–Schur method of SLEPc. All vectors are where the rows
/// of M are; shapes come to this process when they are found. `sweeps` are restarts.
///
/// Multiple eigenvalues: searches without what is found follow until one finds nothing that is
/// wanted. That none is missing holds as far as searches from other vectors tell.
/// @param factor of the plug-in, of A
/// @return fewer pairs, and not complete, if the search does not converge
/// @throws NumericalError if it fails, with the reason
InversePairs shared_pairs(void* factor, const DividedPencil& of);

}  // namespace buckens::linalg
