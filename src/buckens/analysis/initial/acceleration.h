// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Computes accelerations and multipliers consistent with positions, velocities and loads at
/// state.t, FM (35), (36) with (20) differentiated twice. No factorisation: M by conjugate
/// gradients.
/// @param rows_in_use independent rows of λ; the others stay zero
/// @param given per rigid row: acts with the force that it has, closed or not; empty: none
/// @throws NumericalError if the accelerations of frames and meshes do not converge
void compute_accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                           const std::vector<int>& rows_in_use, model::State& state,
                           const std::vector<char>& given = {});

}  // namespace buckens::analysis
