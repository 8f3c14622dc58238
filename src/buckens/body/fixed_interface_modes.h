// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"
#include "buckens/body/free_modes.h"

namespace buckens::body {

/// Vibrations of a body whose interface values are held, N d = 0, lowest first. Rigid motions that
/// the interface does not prevent come first, with ω = 0.
///
/// Dense up to 600 variables, above that by simultaneous inverse iteration on
/// (1 − G (N G)⁺N)(K + μM)⁻¹M with G = (K + μM)⁻¹Nᵀ.
/// @param count modes wanted; fewer are returned if there are fewer
/// @throws NumericalError if the iteration does not converge
/// @throws ModelError if a third of all modes of more than 4000 variables is requested
FreeModes fixed_interface_modes(const FlexiblePart& part, int count);

}  // namespace buckens::body
