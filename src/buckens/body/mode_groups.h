// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "buckens/body/free_modes.h"

namespace buckens::body {

/// Computes the lowest vibrations, so many or all that there are.
using ModeSolver = std::function<FreeModes(int)>;

/// The `count` lowest vibrations and those that belong together with the last of them: a basis with
/// one of two vibrations of equal frequency prefers a direction that the body does not.
///
/// Frequencies that differ by less than 1e-3 of themselves belong together. Equal ones, as square
/// and round bodies have them, differ by rounding; a mesh that is less symmetric than its body
/// splits them by its error.
/// @return fewer than `count` where there are fewer
FreeModes lowest_groups(int count, const ModeSolver& lowest);

/// All vibrations up to a frequency [rad/s], and those that belong together with the last of them.
/// @param first_trial vibrations computed at first, > 0
FreeModes groups_up_to(double cutoff, int first_trial, const ModeSolver& lowest);

}  // namespace buckens::body
