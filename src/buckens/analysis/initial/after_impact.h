// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// What takes part in an impact.
enum class Inertia { frames, frames_and_meshes };

/// Closes the rates of joints and closed rigid rows by the least change of velocities.
/// @param inertia whether meshes answer the impulses, or bodies are taken as rigid
/// @throws NumericalError at a singular position
void close_rates(const model::Model& model, const std::vector<int>& rows_in_use,
                 const dynamics::MassMetric& metric, Inertia inertia, model::State& state);

/// Accelerations, multipliers and forces of rigid rows after an impact or a change of rigid rows,
/// see settle_rigid_rows().
///
/// A smooth step has ended with the accelerations of the motion without the impact. Those of the
/// motion after it differ, since joints carry other forces at other velocities; where all bodies
/// are rigid, the rest of the step is given the difference. Meshes are left as they are: their
/// accelerations would bring in vibrations that the step does not resolve.
/// @param rest time between impact and end of the step [s]
/// @throws NumericalError as settle_rigid_rows()
void settle_after_impact(const model::Model& model, const dynamics::MassMetric& metric,
                         const std::vector<int>& rows_in_use, double rest, model::State& state);

}  // namespace buckens::analysis
