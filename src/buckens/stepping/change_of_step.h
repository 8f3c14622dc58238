// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// Whether the state's algorithmic accelerations are for another step length than the scheme's.
bool must_rescale(const model::State& state, const Scheme& scheme);

/// Moves the algorithmic accelerations from t + δ·h_old to t + δ·h_new, δ the method's offset:
///
///     a ← ẍ + (h_new/h_old)(a − ẍ)
///
/// Without this, changing the step is a first-order error.
void rescale_algorithmic(model::State& state, const Scheme& scheme);

}  // namespace buckens::stepping
