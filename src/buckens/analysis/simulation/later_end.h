// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"

namespace buckens::analysis {

/// The grid of steps of a run that goes on.
struct StepGrid {
  double start = 0;         ///< [s]
  double longest_step = 0;  ///< [s]
};

/// Changes of the model, as for `--set`, that move the end of a run and keep its steps and the
/// times of its records as they are: without them, these would follow from the duration.
/// @param until new end [s]; the run ends with the step that reaches it
std::vector<std::string> changes_for_end(const model::ModelDescription& description,
                                         const StepGrid& steps, double until);

}  // namespace buckens::analysis
