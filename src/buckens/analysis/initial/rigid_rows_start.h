// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Finds accelerations, multipliers and forces of rigid rows that are consistent with each other: a
/// row whose set does not admit the force that would hold it gets the stand that the set requires.
/// @throws NumericalError naming the loads for which no stands satisfy all sets
void settle_rigid_rows(const model::Model& model, const dynamics::MassMetric& metric,
                       const std::vector<int>& rows_in_use, model::State& state);

}  // namespace buckens::analysis
