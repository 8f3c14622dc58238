// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/model.h"
#include "buckens/stepping/stepper.h"

namespace buckens::analysis {

/// Judges the step before a run: compares it with the lowest elastic vibration that joints and
/// loads of each flexible body excite. One sentence of advice per body whose step is too long,
/// empty if all is well. Costs a few solves with the existing factor, no further factorisation.
std::vector<std::string> judge_step(const model::Model& model, stepping::Stepper& stepper);

}  // namespace buckens::analysis
