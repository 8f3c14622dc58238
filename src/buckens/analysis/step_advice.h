// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/model.h"

namespace buckens::analysis {

/// Elastic vibrations of a flexible body that joints and loads excite [rad/s].
struct ExcitedBand {
  double first = 0;  ///< lowest of all elastic vibrations, excited or not
  double lowest = 0;
  double highest = 0;
};

/// From the ten lowest free vibrations: a mode counts as excited if it gives more than 1 % of the
/// compliance against forces that these modes have at the interface. Zero for bodies without
/// interface. Cost: one dense eigenproblem up to 600 DOF, a few factorisations of its own above.
ExcitedBand excited_band(const body::Body& body);
/// The same of a divided body, with its undivided mesh and the nodes that joints and loads use.
ExcitedBand excited_band(const model::Model& model, const model::WholeBody& whole);

/// What to say of a step h [s]: whether a band is followed (about twelve steps per period), damped
/// in its upper part, or not followed at all. Empty if all is well.
std::string judge_step(const std::string& body, const ExcitedBand& band, double h);

}  // namespace buckens::analysis
