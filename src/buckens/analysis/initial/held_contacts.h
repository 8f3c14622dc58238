// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Lets elastic contacts begin with the friction that has held them in the equilibrium from which
/// the motion starts, as far as their limits admit it.
/// @param state its memory is that of the start
void keep_held(const model::Model& model, const std::vector<HeldContact>& held,
               const std::vector<dynamics::BodyMotion>& motions, model::State& state);

}  // namespace buckens::analysis
