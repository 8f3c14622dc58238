// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Velocities as given in the model file, before joints are considered.
///
/// For a divided body they refer to the whole: its parts get v + ω × r, and the rigid motion of the
/// whole, not of each part, is removed from nodal velocities.
/// @throws InputError for unknown bodies, out-of-plane motions, nodal velocities of rigid
/// bodies
void set_initial_velocities(const model::BuiltModel& built, model::State& state);

}  // namespace buckens::analysis
