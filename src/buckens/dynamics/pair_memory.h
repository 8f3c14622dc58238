// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/state.h"

namespace buckens::dynamics {

/// Fits what a state remembers of loads and coordinates to Model::pair_loads, after these have
/// changed: pairs that are there still keep their states, others begin with none.
/// @param before Model::pair_loads until now
void follow_pairs(const model::Model& model, const std::vector<model::PairLoads>& before,
                  const std::vector<BodyMotion>& motions, model::State& state);
/// The same of what a state of rest remembers of each load, RowMemory::at_rest; empty: nothing.
void follow_pairs(const model::Model& model, const std::vector<model::PairLoads>& before,
                  std::vector<loads::RowStand>& at_rest);

}  // namespace buckens::dynamics
