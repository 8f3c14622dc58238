// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Gives quasi-static bodies the deformation that corresponds to their motion at the start.
///
/// Alternates between accelerations and joint forces of the mechanism with fixed shapes, the
/// deformation K η = load by these forces and the inertia of the motion, and positions and
/// velocities of the frames that close the joints again, until nothing changes [Popp, Dirr and
/// Jahnke]. Without quasi-static bodies only accelerations are computed.
/// @param rows_in_use independent rows of λ
/// @param given per rigid row: acts with the force that it has, closed or not; empty: none
/// @throws NumericalError naming a body whose deformation does not converge
void settle_accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                          const std::vector<int>& rows_in_use, model::State& state,
                          const std::vector<char>& given = {});

}  // namespace buckens::analysis
