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
/// @throws NumericalError naming a body whose deformation does not converge; within a run also the
/// time and the rigid rows that hold
void settle_accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                          const std::vector<int>& rows_in_use, model::State& state,
                          const std::vector<char>& given = {});

bool has_quasi_static_bodies(const model::Model& model);

/// A motor that a blow has torn from the speed that it holds pulls with all it has from then on.
/// Held, it would share the force of the stop with it in any ratio, and shapes would not settle.
/// Nothing is done at the start of a run, nor without quasi-static bodies.
void let_go_of_torn_motors(const model::Model& model, model::State& state);

}  // namespace buckens::analysis
