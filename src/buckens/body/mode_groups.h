// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "buckens/body/free_modes.h"

namespace buckens::body {

/// Computes the lowest vibrations, as many as requested or all there are.
using ModeSolver = std::function<FreeModes(int)>;

/// The `count` lowest vibrations and those that belong with the last of them: a basis with one of
/// two vibrations of equal frequency would prefer a direction that the body does not.
///
/// Frequencies within a relative difference of 1e-3 belong together. The equal ones of square and
/// round bodies differ by rounding; a mesh that is less symmetric than its body splits them by its
/// error.
/// @return fewer than `count` if there are fewer
FreeModes lowest_groups(int count, const ModeSolver& lowest);

/// All vibrations up to a frequency [rad/s], and those that belong with the last of them.
/// @param first_trial vibrations computed at first, > 0
FreeModes groups_up_to(double cutoff, int first_trial, const ModeSolver& lowest);

}  // namespace buckens::body
