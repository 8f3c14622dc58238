// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Solves the linear complementarity problem  D P − b = w,  P ≥ 0,  w ≥ 0,  Pᵀw = 0  with D
/// positive semidefinite, by an active set. Meant for tens of unknowns.
/// @throws StepFailure if none is found within 50 changes of the set per unknown
linalg::Vector solve_complementarity(const linalg::Matrix& D, const linalg::Vector& b);

}  // namespace buckens::stepping
