// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/spec/simulation_spec.h"
#include "buckens/stepping/step_settings.h"
#include "buckens/stepping/time_march.h"

namespace buckens::analysis {

stepping::Method method_of(model::IntegrationMethod method);

/// Step settings requested by the model. Threads and exchange keep their defaults.
stepping::StepSettings step_settings(const model::SimulationSpec& spec);

/// Duration and steps: the longest is adjusted once so that a whole number fits.
/// @param start where the steps begin [s]
stepping::MarchSettings march_settings(const model::SimulationSpec& spec, double start = 0);

}  // namespace buckens::analysis
