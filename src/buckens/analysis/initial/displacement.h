// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Deforms the bodies that `initial` gives nodal displacements, relative to their frames, which
/// stay where they are; rigid motion is sieved out. Parts of a body with several frames take the
/// rigid motion that the field gives them, so joints and ties may be open by small amounts
/// afterwards.
/// @return whether any body is deformed
/// @throws InputError for rigid and quasi-static bodies, and where a static start finds the shape
bool set_initial_displacements(const model::BuiltModel& built, model::State& state);

}  // namespace buckens::analysis
