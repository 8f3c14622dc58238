// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Moves undeformed bodies as little as possible (in the mass metric) until all joints close at
/// state.t: damped Newton with step limits, redundant joints allowed.
/// @param starts coordinates with a value are held there during assembly
/// @return the largest remaining |g|
/// @throws ModelError naming the joint that cannot be closed, and its gap, or the value that joints
///         do not allow
double assemble_positions(const model::Model& model, const dynamics::MassMetric& metric,
                          model::State& state,
                          const std::vector<model::StartCoordinate>& starts = {});

/// Adds the smallest velocities that satisfy all joints: first by the frames alone, so that
/// undeformed bodies start with a rigid velocity field, then by nodal velocities, too, if
/// necessary.
/// @param starts coordinates with a rate get this rate
/// @return the largest remaining |ġ|
/// @throws ModelError naming the joint whose velocity cannot be satisfied
double project_velocities(const model::Model& model, const dynamics::MassMetric& metric,
                          model::State& state,
                          const std::vector<model::StartCoordinate>& starts = {});

}  // namespace buckens::analysis
