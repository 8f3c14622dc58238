// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "buckens/analysis/simulation/output_plan.h"
#include "buckens/analysis/simulation/run_statistics.h"
#include "buckens/analysis/simulation/work_account.h"
#include "buckens/results/field_recorder.h"
#include "buckens/results/recorder.h"
#include "buckens/results/state_interpolation.h"

namespace buckens::analysis {

/// Writes the records of a run into a sink as they fall due, and passes them to the statistics of
/// the run.
class RunRecording {
 public:
  /// What a recording depends on; all of it outlives the recording.
  struct Followed {
    const model::BuiltModel& built;
    const WorkAccount& work;
    RunStatistics& statistics;
    results::Recorder& recorder;
    TaskPool* pool = nullptr;  ///< shares the work of fields, or null
  };
  /// @throws InputError, ModelError if something to be recorded is meaningless
  RunRecording(const Followed& run, const OutputPlan& plan, results::RecordSink& sink);

  /// Advice if the results become very large, otherwise empty.
  std::string size_advice() const;
  /// Opens the sink.
  void begin();
  /// Writes the state at which the run starts.
  void write_start(const model::State& state);
  /// Continues after a time up to which nothing is written.
  void skip_to(double t);
  /// Writes what is due between two states, interpolated if steps do not coincide with it.
  /// @param is_last whether the run ends with this step
  void after_step(const model::State& before, const model::State& after, bool is_last);
  /// Writes a state between the times that are due, unless it has just been written.
  void write_between(const model::State& before, const model::State& after);
  void finish(const results::RunSummary& summary);

  /// Saves or restores what later values depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

  /// Wall time of all records so far [s].
  double seconds() const { return seconds_; }

 private:
  double next_record() const { return static_cast<double>(records_) * plan_.every; }
  /// @param levels energies and work instead of those of the state
  void write_record(const model::State& state,
                    const std::optional<results::EnergyLevels>& levels = {});
  void write_fields(const model::State& state);
  void write_extremes();

  const model::BuiltModel& built_;
  const WorkAccount& work_;
  RunStatistics& statistics_;
  OutputPlan plan_;
  results::RecordSink& sink_;
  results::Recorder& recorder_;
  results::FieldRecorder fields_;
  std::chrono::steady_clock::time_point extremes_written_ = std::chrono::steady_clock::now();
  bool is_first_ = true;  // no fields are written yet
  long records_ = 1;      // the state at t = 0 is written before the first step
  double last_written_ = 0;
  // Of the records on the grid of times, which a longer run has, too; negative: none yet.
  double last_due_ = -1, last_due_fields_ = -1;
  double seconds_ = 0;
};

}  // namespace buckens::analysis
