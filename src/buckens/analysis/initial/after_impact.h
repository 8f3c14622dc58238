// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"
#include "buckens/stepping/stepper.h"

namespace buckens::analysis {

/// Closes the rates of joints and closed rigid rows by impulses along them.
/// @param meshes gives the response of meshes to impulses, as in impacts, with what its steps
///        resolve; null: bodies are taken as rigid
/// @throws NumericalError at a singular position
void close_rates(const model::Model& model, const std::vector<int>& rows_in_use,
                 const stepping::Stepper* meshes, model::State& state);

/// Closes joints that are slightly open, by the smallest motion in the same metric. A gap that
/// remains is closed by the next step.
/// @throws NumericalError at a singular position
void close_gaps(const model::Model& model, const std::vector<int>& rows_in_use,
                const stepping::Stepper* meshes, model::State& state);

/// Accelerations, multipliers and forces of rigid rows after an impact or a change of rigid rows,
/// see settle_rigid_rows().
///
/// A smooth step has ended with the accelerations of the motion without the impact. Those of the
/// motion after the impact differ, because joint forces depend on velocities. If all bodies are
/// rigid, the difference is applied over the rest of the step. Meshes are left as they are: their
/// accelerations would excite vibrations that the step does not resolve.
/// @param before state before the step, whose samples hold until its end
/// @param rest time between impact and end of the step [s]
/// @throws NumericalError as settle_rigid_rows()
void settle_after_impact(const model::Model& model, const dynamics::MassMetric& metric,
                         const std::vector<int>& rows_in_use, const model::State& before,
                         double rest, model::State& state);

}  // namespace buckens::analysis
