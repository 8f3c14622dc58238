// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Finds accelerations, multipliers and the forces of rigid rows that belong together: rows whose
/// set does not admit the force that would hold them go where the set puts them.
/// @throws NumericalError naming the loads that find no stand that suits all
void settle_rigid_rows(const model::Model& model, const dynamics::MassMetric& metric,
                       const std::vector<int>& rows_in_use, model::State& state);

}  // namespace buckens::analysis
