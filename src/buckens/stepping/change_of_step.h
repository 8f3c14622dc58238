// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// Whether the state's algorithmic accelerations belong to steps of another length than scheme.h.
bool must_rescale(const model::State& state, const Scheme& scheme);

/// Moves the algorithmic accelerations from t + δ·h_old to t + δ·h_new, δ the method's offset:
///
///     a ← ẍ + (h_new/h_old)(a − ẍ)
///
/// Without this a changed step is an error of first order.
void rescale_algorithmic(model::State& state, const Scheme& scheme);

}  // namespace buckens::stepping
