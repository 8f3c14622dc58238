// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Accelerations where force laws see reactions or remember: friction takes its share of the first
/// instant.
///
/// Laws that slide from the start have their states already. Those at rest are strained until their
/// coordinate does not accelerate, or as far as they can be: what friction can hold stays where it
/// is. Cost: some 10 computations of the accelerations, and 5 for each law at rest.
/// @param state with memory and accelerations, which are made consistent
void settle_friction(const model::Model& model, const dynamics::MassMetric& metric,
                     const std::vector<int>& rows_in_use, model::State& state);

}  // namespace buckens::analysis
