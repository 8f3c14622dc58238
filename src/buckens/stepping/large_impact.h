// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/matrix_types.h"
#include "buckens/stepping/cone_newton.h"

namespace buckens::stepping {

/// Impulses of an impact, (I1) and (I2), of many places, as in a heap of balls.
///
/// Uses Newton's method of stepping/cone_newton.h with sparse factors, and sweeps over the places
/// where this makes no progress; the cost of both is proportional to the number of pairs of places
/// on a common body. Shares of places that hold the same thing are not quite equal. The last resort
/// is a series of convex problems (stepping/cone_rounds.h).
/// @param D of all rows, positive semidefinite
/// @param are_near set if impulses are those of ConeEnd::near
/// @throws StepFailure if none of these methods converges, or only to impulses that cancel each
/// other: friction jams
linalg::Vector solve_large_impact(const linalg::SparseMatrix& D, const linalg::Vector& b,
                                  const std::vector<ConeRows>& places, bool* are_near = nullptr);

}  // namespace buckens::stepping
