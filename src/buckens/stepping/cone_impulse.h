// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Of one place: across, and at most two directions along. Without memory from the heap.
using PlaceVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using PlaceMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// Impulse of one place where two bodies strike, across the surface and along none to two
/// directions of it: with w = B P + v, index 0 across,
///
///     w₀ ≥ 0,  P₀ ≥ 0,  P₀ w₀ = 0;   |P_t| ≤ μ P₀ and w_t = 0, or P_t = −μ P₀ w_t/|w_t| (I3)
///
/// It exists for any v where B is positive definite: P_t is a function of P₀, so w₀ is, too, and it
/// grows without bound. Cost: about that of ten eigenvalue problems of 2×2 matrices.
/// @param B answers of the rates to the impulses, @param v rates without them
/// @param coefficient μ, @param none answers up to this are rounding: nothing moves that way
/// @throws StepFailure where B is singular and friction jams
PlaceVector cone_impulse(const PlaceMatrix& B, const PlaceVector& v, double coefficient,
                         double none);

/// Impulse along the surface, at most of the size `most`, that stops a slip or is against what
/// remains of it. @param B answers of the slip to it, @param slip without it
PlaceVector rub_impulse(const PlaceMatrix& B, const PlaceVector& slip, double most, double none);

}  // namespace buckens::stepping
