// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/run.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/initial/after_impact.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/analysis/simulation/seconds_since.h"
#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/base/free_memory.h"
#include "buckens/base/log.h"
#include "buckens/base/timed_phase.h"
#include "buckens/base/version.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/pair_memory.h"

namespace buckens::analysis {

namespace {

const model::SimulationSpec& simulation_of(const model::ModelDescription& description) {
  if (description.simulation) return *description.simulation;
  throw InputError(description.where,
                   "there is nothing to run: the model has no `simulation:`; add for example "
                   "`simulation: {duration: 1 s, step: 1 ms}`");
}

}  // namespace

SimulationRun::SimulationRun(const model::BuiltModel& built, SimulationOptions options)
    : own_(built),
      built_(own_.built()),
      options_(std::move(options)),
      spec_(simulation_of(built.description)),
      views_(built.model) {
  base::take_phases();
  summary_.wall_seconds.preparation = built.phases;
  set_up();
  base::return_free_memory();
  note_preparation(seconds_since(created_));
}

/// @param seconds that this part of the set-up took
void SimulationRun::note_preparation(double seconds) {
  setup_seconds_ += seconds;
  base::PhaseSeconds phases = base::take_phases();
  for (const auto& phase : phases) seconds -= phase.second;
  phases.emplace_back("rest", seconds);
  base::add_phases(phases, summary_.wall_seconds.preparation);
}

void SimulationRun::warn(const std::string& text) {
  const auto& known = summary_.warnings;
  if (std::find(known.begin(), known.end(), text) != known.end()) return;
  summary_.warnings.push_back(text);
  if (options_.tells_warnings) base::log(base::LogLevel::warning, text);
}

void SimulationRun::step() {
  begin_records();
  model::State& state = prepared_->state;
  if (std::exchange(has_new_inputs_, false)) work_->take_inputs(state);
  std::swap(before_, state);
  traffic_.begin_step();
  const stepping::StepReport report = take_step(before_, state);
  ++steps_taken_;
  statistics_->add_step(report, state);
  if (!report.impact_shares.empty()) {
    work_->add_impacts(before_, state, report);
  } else {
    work_->add(state, &before_, &report);
  }
  statistics_->add_touches(work_->of_loads(), state.t - before_.t);
  work_->add_parameters(before_, state);
  if (readings_->follow(*observer_, work_->work(), before_, state)) {
    work_->take_jump(state);
    work_->take_inputs(state);
  }
  const std::vector<EventWatch::Found> found = events_->after_step(before_, state);
  note_events(found);
  if (recording_) recording_->after_step(before_, state, is_done());
  reading_growth_->follow(state.memory.signals);
  watch_->after_step(march_->stepper(), state);
  if (has_samples_ && carries_accelerations()) pass_samples(report);
  act_on_events(found);
  if (own_.pairs() != nullptr) find_pairs();
  for (const auto& callback : callbacks) callback(state.t - before_.t);
}

/// Impacts without held readings have found accelerations with what samples have become.
void SimulationRun::pass_samples(const stepping::StepReport& report) {
  model::State& state = prepared_->state;
  if (report.must_settle && readings_->empty()) return;
  dynamics::Circumstances around = dynamics::circumstances_of(before_);
  around.lambda = &state.lambda;
  dynamics::evaluate_signals(built_.model, dynamics::motions_of(built_.model, state), state.t,
                             around, unsampled_);
  if (unsampled_.values == state.memory.signals) return;
  jump_->note(state, &unsampled_.values);
  jump_->pass(march_->stepper(), state);
  work_->take_force_jump(state, unsampled_.values);
}

void SimulationRun::find_pairs() {
  model::State& state = prepared_->state;
  const auto motions = dynamics::motions_of(built_.model, state);
  const std::vector<model::PairLoads> before = built_.model.pair_loads;
  const auto now = dynamics::find_rigid_pairs(built_.model, motions, march_->next_step());
  const bool are_same =
      std::equal(now.begin(), now.end(), before.begin(), before.end(),
                 [](const model::NearPair& a, const auto& b) { return a == b.pair; });
  if (are_same) return;
  own_.pairs()->set(now);
  dynamics::follow_pairs(built_.model, before, motions, state);
  work_->follow_pairs(state);
}

void SimulationRun::note_events(const std::vector<EventWatch::Found>& found) {
  for (const EventWatch::Found& event : found) {
    std::string text = event.text;
    if (event.stops) {
      text += "; the run ends here";
      is_stopped_ = is_at_end_ = true;
    }
    base::log(base::LogLevel::info, text);
    told_events_.push_back(text);
    summary_.notes.push_back(std::move(text));
  }
}

/// Lets events act on the state at the end of the step, and those that follow from what they do.
void SimulationRun::act_on_events(std::vector<EventWatch::Found> found) {
  model::State& state = prepared_->state;
  bool has_acted = false;
  const auto longest_stepper = [this]() -> const stepping::Stepper& {
    return march_->longest_stepper();
  };
  for (bool is_first = true; !found.empty(); is_first = false) {
    if (!is_first) note_events(found);
    const std::vector<double> signals = state.memory.signals;
    for (const EventWatch::Found& event : found) {
      if (recording_ && (event.spec->records || (event.stops && !is_first))) {
        recording_->write_between(before_, state);
      }
      if (!event.spec->acts()) continue;
      const EventActions::Effect effect = actions_->apply(*event.spec, longest_stepper, state);
      work_->take_event(state, effect.gained, effect.lost);
      has_acted = has_acted || event.spec->changes_motion();
    }
    found = events_->after_actions(signals, state);
  }
  if (!has_acted) return;
  actions_->settle(state);
  work_->restart(state);
  march_->restart(state);
  observed_at_ = -1;
}

void SimulationRun::step_by_hand() {
  const auto start = Clock::now();
  step();
  stepping_seconds_ += seconds_since(start);
}

results::RunSummary SimulationRun::run() {
  const auto start = Clock::now();
  std::exception_ptr failure;
  try {
    begin_records();
    take_steps();
  } catch (const NumericalError& error) {
    summary_.interrupted = error.what();
    summary_.trust.push_back("the run ended early by a numerical failure");
    failure = std::current_exception();
  }
  stepping_seconds_ += seconds_since(start);
  finish();
  if (failure) std::rethrow_exception(failure);
  return summary_;
}

void SimulationRun::take_steps() {
  if (!report_progress()) return;
  while (!is_over()) {
    step();
    if (!report_progress() && !is_done()) return;
  }
}

/// @throws NumericalError; `after` is then as `before`
stepping::StepReport SimulationRun::take_step(const model::State& before, model::State& after) {
  const base::AllowedThreads threads(pool_.get());  // another step size needs another factor
  const double reach = std::min(before.t + march_->longest_step(), spec_.duration);
  try {
    bool is_too_long_once = false;
    const stepping::StepReport report = march_->advance(
        before, after,
        [this](const model::State& from, const model::State& to) { return holds_action(from, to); },
        [&](const model::State& from, const model::State& to) {
          const bool is_too_long = powers_->exceeds(from, to, march_->longest_step());
          is_too_long_once = is_too_long_once || is_too_long;
          return is_too_long;
        });
    // Errors of what the method carries would grow as the steps become longer again.
    const bool is_short = !march_->is_controlled() && 1.5 * (after.t - before.t) < reach - before.t;
    if (is_too_long_once || (powers_->any() && is_short)) march_->forget_force(after);
    drives_->check(before.t, after.t);
    shafts_->check(before, after);
    growth_->follow(after.memory.signals);
    // The step closed velocities with the shapes of quasi-static bodies at its start.
    if (has_quasi_static_) project_velocities(built_.model, *metric_, after);
    if (report.must_settle) settle(before, after, report);
    return report;
  } catch (const NumericalError& failure) {
    after = before;
    // A law that jumps makes any step fail, and explains more than the failing joint.
    drives_->check(before.t, reach);
    shafts_->check_failed(before);
    growth_->check_failed(failure);
    throw;
  }
}

/// Whether a step that is tried contains an event for which it is to be shorter.
bool SimulationRun::holds_action(const model::State& from, const model::State& to) {
  if (readings_->empty() || built_.description.events.empty()) {
    return events_->holds_action(from, to);
  }
  model::State seen = to;
  readings_->follow(*observer_, work_->work(), from, seen);
  return events_->holds_action(from, seen);
}

/// Accelerations that have jumped are found anew, and what foretells the motion begins here.
void SimulationRun::settle(const model::State& before, model::State& state,
                           const stepping::StepReport& report) {
  stepping::Stepper& stepper = march_->stepper();
  if (report.ends_have_turned && stepper.take_mean_of_turning(before, state)) {
    close_rates(built_.model, stepper.rows_in_use(), &stepper, state);
  }
  settle_after_impact(built_.model, *metric_, stepper.rows_in_use(), before, report.impact_rest,
                      state);
  state.history = 0;
  march_->restart(state);
}

bool SimulationRun::report_progress() {
  if (!options_.on_progress) return true;
  if (!options_.on_progress({state().t, spec_.duration, steps_taken_, steps_})) stop();
  return !is_stopped_;
}

results::RunSummary SimulationRun::finish() {
  if (std::exchange(is_finished_, true)) return summary_;
  summary_.finished = is_done() && summary_.interrupted.empty();
  if (!summary_.finished && summary_.interrupted.empty()) {
    summary_.interrupted = options_.stop_reason;
  }
  summary_.wall_seconds.setup = setup_seconds_;
  summary_.wall_seconds.stepping = stepping_seconds_;
  summary_.wall_seconds.total = seconds_since(created_);
  split_wall_time();
  summary_.end_time = state().t;
  statistics_->fill(*march_, summary_);
  traffic_.fill(built_.model, summary_);
  summary_.energy_account = work_->account(state());
  watch_->fill(state(), summary_);
  if (recording_) recording_->finish(summary_);
  return summary_;
}

void SimulationRun::split_wall_time() {
  const stepping::StepSeconds s = march_->ladder().seconds();
  const double recording = recording_ ? recording_->seconds() : 0.0;
  const double rest =
      summary_.wall_seconds.stepping - s.large_solves - s.newton - s.completion - recording;
  summary_.wall_seconds.phases = {{"large_solves", s.large_solves},
                                  {"newton", s.newton},
                                  {"completion", s.completion},
                                  {"recording", recording},
                                  {"coupling_and_rest", rest}};
}

}  // namespace buckens::analysis
