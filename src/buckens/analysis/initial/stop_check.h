// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Refuses to start beyond the free way of a rigid stop, which can hold but not push back.
/// @throws ModelError naming the load and how far it is beyond
void refuse_beyond_stops(const model::Model& model, const model::State& state);

}  // namespace buckens::analysis
