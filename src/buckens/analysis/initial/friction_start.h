// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Accelerations with force laws that depend on reactions or have memory: initial state of
/// friction.
///
/// Laws that slide from the start already have their states. Those at rest are strained until their
/// coordinate does not accelerate, or to their limit: what friction can hold does not move. Cost:
/// about 10 computations of the accelerations, and 5 for each law at rest.
/// @param state with memory and accelerations, which are made consistent
void settle_friction(const model::Model& model, const dynamics::MassMetric& metric,
                     const std::vector<int>& rows_in_use, model::State& state);

}  // namespace buckens::analysis
