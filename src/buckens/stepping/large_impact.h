// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/matrix_types.h"
#include "buckens/stepping/cone_newton.h"

namespace buckens::stepping {

/// Impulses of an impact, (I1) and (I2), of many places, as in a heap of balls.
///
/// Newton's method of stepping/cone_newton.h with sparse factors, and sweeps over the places where
/// it gains nothing: the cost of both follows the number of pairs of places on a common body. What
/// places share is not quite shared alike. At last by convex problems (stepping/cone_rounds.h).
/// @param D of all rows, positive semidefinite
/// @param are_near set where impulses are those of ConeEnd::near
/// @throws StepFailure where none of them comes to an end, or only with impulses that cancel each
/// other: friction that jams
linalg::Vector solve_large_impact(const linalg::SparseMatrix& D, const linalg::Vector& b,
                                  const std::vector<ConeRows>& places, bool* are_near = nullptr);

}  // namespace buckens::stepping
