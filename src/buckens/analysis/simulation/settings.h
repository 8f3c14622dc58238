// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/spec/simulation_spec.h"
#include "buckens/stepping/step_settings.h"
#include "buckens/stepping/time_march.h"

namespace buckens::analysis {

stepping::Method method_of(model::IntegrationMethod method);

/// How a step is taken, as the model asks for it. Threads and exchange are left as they begin.
stepping::StepSettings step_settings(const model::SimulationSpec& spec);

/// How far and in which steps: the longest is adjusted once so that a whole number fits.
stepping::MarchSettings march_settings(const model::SimulationSpec& spec);

}  // namespace buckens::analysis
