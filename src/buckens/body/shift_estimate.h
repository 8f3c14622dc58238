// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"

namespace buckens::body {

/// Upper bound for the lowest elastic ω² of a free body [1/s²], without factorising anything.
///
/// Rayleigh–Ritz on displacement fields that are linear and quadratic in the coordinates, nodal
/// rotations as half their curl, rigid motion sieved out. The bending of a slender beam is
/// estimated within a few per cent; a body of many thin members may bend far more easily than the
/// bound says.
/// @return 0 if none of these fields has inertia
double lowest_square_estimate(const FlexiblePart& part);

}  // namespace buckens::body
