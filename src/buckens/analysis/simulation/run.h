// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/initial/force_jump.h"
#include "buckens/analysis/initial/prepare.h"
#include "buckens/analysis/simulation/coupling_watch.h"
#include "buckens/analysis/simulation/drive_laws.h"
#include "buckens/analysis/simulation/event_actions.h"
#include "buckens/analysis/simulation/event_watch.h"
#include "buckens/analysis/simulation/held_readings.h"
#include "buckens/analysis/simulation/nodal_views.h"
#include "buckens/analysis/simulation/output_plan.h"
#include "buckens/analysis/simulation/power_watch.h"
#include "buckens/analysis/simulation/reading_growth.h"
#include "buckens/analysis/simulation/run_recording.h"
#include "buckens/analysis/simulation/run_statistics.h"
#include "buckens/analysis/simulation/shaft_watch.h"
#include "buckens/analysis/simulation/signal_growth.h"
#include "buckens/analysis/simulation/simulation.h"
#include "buckens/analysis/simulation/step_advice.h"
#include "buckens/analysis/simulation/step_traffic.h"
#include "buckens/analysis/simulation/work_account.h"
#include "buckens/base/task_pool.h"
#include "buckens/model/build/paired_model.h"
#include "buckens/results/recorder.h"
#include "buckens/stepping/time_march.h"

namespace buckens::analysis {

/// The parts of one simulation and how they work together; Simulation is its public interface.
class SimulationRun {
 public:
  /// Sets up everything except records.
  SimulationRun(const model::BuiltModel& built, SimulationOptions options);

  void record_into(results::RecordSink& sink);
  /// @pre neither done nor stopped
  void step();
  /// The same, and measures its time.
  void step_by_hand();
  results::RunSummary run();
  results::RunSummary finish();

  /// Values of all channels at the current state, at a fixed address.
  const std::vector<double>& observe();
  const results::RecordLayout& layout() const { return observer_->layout(); }
  NodalViews& nodal_views() { return views_; }
  void set_load(const std::string& load, const std::optional<Eigen::Vector3d>& value);
  void set_signal(const std::string& signal, double value);
  double signal(const std::string& name) const;

  void save(const base::SaveVisit& visit);
  void restore(const base::SavedValues& saved, Leeway leeway);

  void stop() { is_stopped_ = true; }
  bool is_over() const { return is_stopped_ || is_done(); }
  bool is_stopped() const { return is_stopped_; }
  bool is_done() const { return is_at_end_ || march_->is_done(); }
  double longest_step() const { return march_->longest_step(); }
  double duration() const { return spec_.duration; }
  long num_steps() const { return steps_taken_; }
  const model::BuiltModel& built() const { return built_; }
  const model::State& state() const { return prepared_->state; }

  /// Called with the length of each accepted step.
  std::vector<std::function<void(double)>> callbacks;

 private:
  using Clock = std::chrono::steady_clock;

  void check_method();
  void fit_to_samples(stepping::MarchSettings& march) const;
  void check_samples() const;
  void begin_march(double start);
  void set_up();
  /// Finds the pairs in rigid contact groups that are near each other in the next step.
  void find_pairs();
  void note_solvers();
  void warn(const std::string& text);
  void advise_on_step();
  void advise(const std::string& body, const ExcitedBand& band);
  void set_lowest_frequency(int body, double omega);
  void note_events(const std::vector<EventWatch::Found>& found);
  void act_on_events(std::vector<EventWatch::Found> found);
  void begin_records();
  /// Newmark's method begins a step with the forces that act then, not with accelerations.
  bool carries_accelerations() const { return spec_.method != model::IntegrationMethod::newmark; }
  /// Lets accelerations follow samples at the end of a step.
  void pass_samples(const stepping::StepReport& report);
  void take_steps();
  stepping::StepReport take_step(const model::State& before, model::State& after);
  bool holds_action(const model::State& from, const model::State& to);
  void settle(const model::State& before, model::State& state, const stepping::StepReport& report);
  bool report_progress();
  void split_wall_time();
  void note_preparation(double seconds);
  std::vector<std::size_t> loads_with_values(const std::string& name) const;
  std::size_t find_signal(const std::string& name) const;
  void visit_saved(const base::SaveVisit& visit);
  std::vector<std::string> identity() const;

  model::PairedModel own_;
  const model::BuiltModel& built_;
  SimulationOptions options_;
  std::unique_ptr<TaskPool> pool_;  // null with one thread
  const model::SimulationSpec& spec_;
  Clock::time_point created_ = Clock::now();
  double setup_seconds_ = 0, stepping_seconds_ = 0;
  StepTraffic traffic_;
  OutputPlan plan_;
  std::optional<dynamics::MassMetric> metric_;
  std::optional<Prepared> prepared_;
  model::State before_;  // the state before the last step
  std::optional<stepping::TimeMarch> march_;
  std::optional<WorkAccount> work_;
  std::optional<DriveLaws> drives_;
  std::optional<ShaftWatch> shafts_;
  std::optional<SignalGrowth> growth_;
  std::optional<ReadingGrowth> reading_growth_;
  std::optional<PowerWatch> powers_;
  std::optional<EventWatch> events_;
  std::optional<EventActions> actions_;
  std::optional<RunStatistics> statistics_;
  std::optional<CouplingWatch> watch_;
  std::optional<results::Recorder> observer_;
  std::optional<HeldReadings> readings_;
  std::optional<ForceJump> jump_;
  dynamics::SignalValues unsampled_;  // at the end of the last step, samples there not yet taken
  std::optional<RunRecording> recording_;
  std::optional<base::SavedValues> restored_;  // kept until it has been recorded
  results::RunSummary summary_;
  NodalViews views_;
  std::vector<double> observed_;          // values of all channels
  long observed_at_ = -1;                 // number of steps, −1: out of date
  long steps_ = 0;                        // total; 0 if unknown because of step control
  double march_start_ = 0;                // where the grid of steps begins [s]
  std::vector<std::string> told_events_;  // notes on them, since t = 0
  long steps_taken_ = 0;
  bool has_begun_ = false;  // the record of the start is written
  bool is_stopped_ = false;
  bool is_at_end_ = false;    // by an event
  bool is_finished_ = false;  // records are finished
  bool has_new_inputs_ = false;
  bool has_quasi_static_ = false;
  bool has_samples_ = false;
};

}  // namespace buckens::analysis
