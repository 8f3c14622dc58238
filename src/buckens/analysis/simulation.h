// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "buckens/linalg/solve_exchange.h"
#include "buckens/model/model_builder.h"
#include "buckens/model/state.h"
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
  /// Called by run() at its start and after every step; returning false ends the run after this
  /// step.
  std::function<bool(const Progress&)> on_progress;
  /// Why on_progress said no, for the summary: "interrupted by the user".
  std::string stop_reason = "stopped";
  int threads = 1;  ///< ≥ 1; has no influence on results
  /// Whether warnings of the set-up go to the log; they stand in the summary anyhow.
  bool tells_warnings = true;
  /// Shares factors and solves with other simulations that run side by side; null: alone.
  linalg::SolveExchange* exchange = nullptr;
};

/// A simulation of a model: set up once, then advanced step by step or to its end.
class Simulation {
 public:
  /// Prepares: assembly, one factorisation per flexible body, consistent start.
  /// @param built outlives the simulation
  /// @throws InputError without a `simulation:`, ModelError if the mechanism cannot be assembled,
  ///         NumericalError naming the joint or body that resists
  explicit Simulation(const model::BuiltModel& built, SimulationOptions options = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Opens a sink, which from now on gets the records that the model asks for, the state of now
  /// before the first step. @pre no step was taken
  /// @throws InputError, ModelError where a sensor makes no sense, IoError from the sink
  void record_into(results::RecordSink& sink);

  /// Takes one accepted step. @return false if the end was reached before
  /// @throws NumericalError naming the joint or body that resists; the state is then that before
  bool step();
  /// Takes steps until the end, or until on_progress says no, and finishes the records.
  ///
  /// A step that fails ends the run: the sink gets everything up to it and a summary with
  /// `finished` false, then the error is thrown on.
  results::RunSummary run();

  double time() const;  ///< [s]
  bool is_done() const;
  const model::State& state() const;

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace buckens::analysis
