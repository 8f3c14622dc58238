// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Deforms the bodies to which `initial` gives nodal displacements, relative to their frames,
/// which do not move; rigid motion is sieved out. Parts of a body with several frames take
/// the rigid motion that the field gives them, so joints and ties may have small gaps
/// afterwards.
/// @return whether any body is deformed
/// @throws InputError for rigid and quasi-static bodies, and if a static start determines the shape
bool set_initial_displacements(const model::BuiltModel& built, model::State& state);

}  // namespace buckens::analysis
