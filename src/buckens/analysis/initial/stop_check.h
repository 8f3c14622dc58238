// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Refuses a position beyond the free way of a rigid stop, which can hold but not push back: a
/// start there, or an equilibrium, which is found without rigid stops.
/// @throws ModelError naming the load and how far it is beyond
void refuse_beyond_stops(const model::Model& model, const model::State& state);

}  // namespace buckens::analysis
