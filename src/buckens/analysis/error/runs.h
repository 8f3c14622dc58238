// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "buckens/analysis/error/sensor_curves.h"
#include "buckens/analysis/error/variants.h"
#include "buckens/analysis/simulation/simulate.h"

namespace buckens::analysis {

struct ErrorRunOptions {
  /// Called before each run. @param index from 0
  std::function<void(const results::ErrorSource& source, std::size_t index, std::size_t count)>
      on_begin;
  /// As SimulationOptions::on_progress; false ends the statement with what is known by then.
  std::function<bool(const Progress&)> on_progress;
  int threads = 1;
};

/// Runs the variants of a model and states the uncertainty of the sensors of its run.
///
/// A variant that cannot be built or run does not end the others: a note says why.
/// @param run sensors of the run itself, finished
results::ErrorStatement state_errors(const ErrorVariants& variants, const SensorCurves& run,
                                     const ErrorRunOptions& options = {});

/// Reasons to doubt a run, from its error statement.
std::vector<std::string> doubts(const results::ErrorStatement& statement);

}  // namespace buckens::analysis
