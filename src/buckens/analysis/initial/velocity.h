// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Velocities as the model file gives them, before joints are considered.
///
/// Those of a divided body are the ones of the whole: its parts get v + ω × r, and nodal velocities
/// lose the rigid motion of the whole, not that of each part.
/// @throws InputError for unknown bodies, motions out of the plane, nodal velocities of rigid
/// bodies
void set_initial_velocities(const model::BuiltModel& built, model::State& state);

}  // namespace buckens::analysis
