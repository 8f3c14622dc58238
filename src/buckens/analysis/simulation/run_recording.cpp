// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/run_recording.h"

#include <algorithm>
#include <cmath>

#include "buckens/analysis/simulation/seconds_since.h"
#include "buckens/dynamics/energy.h"

namespace buckens::analysis {

namespace {

constexpr double kSecondsBetweenExtremes = 1;

}  // namespace

RunRecording::RunRecording(const Followed& run, const OutputPlan& plan, results::RecordSink& sink)
    : built_(run.built),
      work_(run.work),
      statistics_(run.statistics),
      plan_(plan),
      sink_(sink),
      recorder_(run.recorder),
      fields_(run.built, run.pool) {}

std::string RunRecording::size_advice() const {
  return judge_size(plan_.bytes(recorder_.layout(), fields_.layout()));
}

void RunRecording::begin() {
  results::Geometry geometry = recorder_.geometry();
  if (!fields_.is_empty()) {
    fields_.add_places(geometry);
    sink_.begin_fields(fields_.layout());
  }
  sink_.begin(recorder_.layout(), geometry);
  if (!is_first_) write_extremes();  // a continued run has some
}

void RunRecording::write_start(const model::State& state) {
  write_record(state);
  last_due_ = state.t;
}

void RunRecording::after_step(const model::State& before, const model::State& after, bool is_last) {
  if (fields_.watches_steps()) fields_.watch(after);
  const double near = 1e-6 * (after.t - before.t);
  std::optional<results::EnergyLevels> first, last;  // of the step, where a record needs them
  for (; next_record() <= after.t + near; ++records_) {
    const double t = next_record();
    if (std::abs(t - after.t) <= near) {
      model::State state = after;
      state.lambda = results::multipliers_at(before, after, after.t);
      write_record(state);
    } else {
      if (!first) {
        first = {dynamics::energy(built_.model, before), work_.work_before()};
        last = {dynamics::energy(built_.model, after), work_.work()};
      }
      const double share = (t - before.t) / (after.t - before.t);
      write_record(results::interpolate(before, after, t),
                   results::interpolate(*first, *last, share));
    }
    last_due_ = last_written_;
  }
  if (is_last) write_between(before, after);
}

void RunRecording::write_between(const model::State& before, const model::State& after) {
  if (last_written_ >= after.t - 1e-6 * (after.t - before.t)) return;
  model::State state = after;
  state.lambda = results::multipliers_at(before, after, after.t);
  const double due_fields = last_due_fields_;
  write_record(state);
  last_due_fields_ = due_fields;
}

void RunRecording::skip_to(double t) {
  records_ = static_cast<long>(std::floor(t / plan_.every * (1.0 + 1e-9))) + 1;
  last_written_ = t;
}

void RunRecording::finish(const results::RunSummary& summary) {
  if (!is_first_) write_extremes();
  sink_.finish(summary);
}

void RunRecording::write_record(const model::State& state,
                                const std::optional<results::EnergyLevels>& levels) {
  const auto start = std::chrono::steady_clock::now();
  const results::Record record = levels ? recorder_.record(state, levels->work, levels->energy)
                                        : recorder_.record(state, work_.work());
  const dynamics::Energy& e = recorder_.last_energy();
  const double scale = std::max(e.kinetic + e.strain + e.springs, work_.turnover());
  statistics_.add_record(state, recorder_.last_balance(), scale);
  sink_.write(record);
  write_fields(state);
  last_written_ = state.t;
  seconds_ += seconds_since(start);
}

/// @pre the record of this instant is written
void RunRecording::write_fields(const model::State& state) {
  if (fields_.is_empty()) return;
  const double duration = built_.description.simulation->duration;
  const bool is_end = state.t >= (1.0 - 1e-9) * duration;
  const bool is_due = is_first_ || records_ % plan_.fields_stride == 0;
  if (is_due || is_end) {
    if (is_due) last_due_fields_ = state.t;
    sink_.write_fields(fields_.record(state, {{}, &recorder_.last_multipliers(), 1.0}));
  } else if (fields_.has_extremes()) {
    fields_.watch(state);
  }
  if (seconds_since(extremes_written_) > kSecondsBetweenExtremes) write_extremes();
  is_first_ = false;
}

void RunRecording::write_extremes() {
  if (!fields_.has_extremes()) return;
  sink_.write_extremes(fields_.extremes());
  extremes_written_ = std::chrono::steady_clock::now();
}

}  // namespace buckens::analysis
