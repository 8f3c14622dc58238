// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "buckens/linalg/solve_exchange.h"
#include "buckens/model/model_builder.h"
#include "buckens/results/record_sink.h"

namespace buckens::analysis {

/// How far a run has come.
struct Progress {
  double t = 0;         ///< simulated time [s]
  double duration = 0;  ///< [s]
  long step = 0;
  long steps = 0;  ///< in all; 0 where step control leaves that open
};

struct SimulationOptions {
  /// Called after set-up and after every step; returning false ends the run after this step.
  std::function<bool(const Progress&)> on_progress;
  /// Why on_progress said no, for the summary: "interrupted by the user".
  std::string stop_reason = "stopped";
  int threads = 1;  ///< ≥ 1; has no influence on results
  /// Whether warnings of the set-up go to the log; they stand in the summary anyhow.
  bool tells_warnings = true;
  /// Shares factors and solves with other simulations that run side by side; null: alone.
  linalg::SolveExchange* exchange = nullptr;
};

/// Runs the simulation the model file asks for: set-up, one factorisation per flexible body, steps,
/// records into `sink`. The summary goes to the sink and is returned.
///
/// A step that fails ends the run: the sink gets everything up to it and a summary with
/// `finished` false, then the error is thrown on.
/// @throws InputError without a `simulation:`, ModelError if the mechanism cannot be assembled,
///         NumericalError naming the joint or body that resists, IoError from the sink
results::RunSummary simulate(const model::BuiltModel& built, results::RecordSink& sink,
                             const SimulationOptions& options = {});

}  // namespace buckens::analysis
