// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Gives balls with rigid friction that slides from rest the direction of sliding: against the
/// acceleration, which depends on it. The torques that would hold them do not give that direction.
/// Bodies with meshes answer as if they were rigid.
/// @param state with settled stands of rigid rows and accelerations; the latter follow
void aim_balls(const model::Model& model, const dynamics::MassMetric& metric,
               const std::vector<int>& rows_in_use, model::State& state);

}  // namespace buckens::analysis
