// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/analysis/simulation/simulation.h"

namespace buckens::analysis {

/// Runs the simulation of the model file: set-up, one factorisation per flexible body, steps,
/// records into `sink`. The summary goes to the sink and is returned.
///
/// A step that fails ends the run: the sink gets everything up to it and a summary with `finished`
/// false, then the error is rethrown.
/// @throws InputError without a `simulation:`, ModelError if the mechanism cannot be assembled,
///         NumericalError naming the joint or body that resists, IoError from the sink
results::RunSummary simulate(const model::BuiltModel& built, results::RecordSink& sink,
                             const SimulationOptions& options = {});

}  // namespace buckens::analysis
