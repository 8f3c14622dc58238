// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "buckens/analysis/coupling_watch.h"
#include "buckens/analysis/drive_laws.h"
#include "buckens/analysis/output_plan.h"
#include "buckens/analysis/position_assembly.h"
#include "buckens/analysis/prepare.h"
#include "buckens/analysis/run_statistics.h"
#include "buckens/analysis/step_advice.h"
#include "buckens/analysis/work_account.h"
#include "buckens/base/errors.h"
#include "buckens/base/free_memory.h"
#include "buckens/base/log.h"
#include "buckens/base/version.h"
#include "buckens/results/field_recorder.h"
#include "buckens/results/recorder.h"
#include "buckens/results/state_interpolation.h"
#include "buckens/stepping/time_march.h"

namespace buckens::analysis {

namespace {

constexpr double kSecondsBetweenExtremes = 1;
constexpr Eigen::Index kAdvisedDofs = 600;
// With `step: auto` the longest step is this part of the duration.
constexpr long kStepsOfLongest = 100;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

stepping::Method method_of(model::IntegrationMethod method) {
  switch (method) {
    case model::IntegrationMethod::newmark:
      return stepping::Method::newmark;
    case model::IntegrationMethod::hht:
      return stepping::Method::hht;
    case model::IntegrationMethod::wilson:
      return stepping::Method::wilson;
    case model::IntegrationMethod::generalized_alpha:
      break;
  }
  return stepping::Method::generalized_alpha;
}

stepping::StepSettings step_settings(const model::SimulationSpec& spec) {
  stepping::StepSettings settings;
  settings.method = method_of(spec.method);
  settings.rho_inf = spec.rho_inf;
  settings.alpha = spec.alpha.value_or(settings.alpha);
  settings.theta = spec.theta.value_or(settings.theta);
  settings.position_projection = spec.projection;
  settings.newton_tolerance = spec.newton_tolerance;
  settings.outer_tolerance = spec.outer_tolerance;
  settings.iterate_coupling = spec.iterate_coupling;
  settings.max_newton = spec.max_iterations;
  settings.max_outer = spec.max_outer_iterations;
  return settings;
}

/// How far and in which steps: the longest is adjusted once so that a whole number fits.
stepping::MarchSettings march_settings(const model::SimulationSpec& spec) {
  stepping::MarchSettings march;
  march.duration = spec.duration;
  const double longest = spec.step.value_or(0.0);
  march.longest_steps = kStepsOfLongest;
  if (longest > 0.0) {
    march.longest_steps = std::max(1L, std::lround(std::ceil(spec.duration / longest - 1e-9)));
  }
  if (spec.has_step_control()) {
    march.tolerance.emplace();
    march.tolerance->relative = spec.tolerance.value_or(march.tolerance->relative);
    march.tolerance->absolute = spec.absolute_tolerance;
  }
  return march;
}

/// One run from start to end.
class Simulation {
 public:
  Simulation(const model::BuiltModel& built, results::RecordSink& sink,
             const SimulationOptions& options)
      : built_(built), sink_(sink), options_(options), spec_(*built.description.simulation) {}

  results::RunSummary run() {
    const auto start = std::chrono::steady_clock::now();
    set_up();
    base::return_free_memory();
    summary_.wall_seconds.setup = seconds_since(start);
    const auto stepping_start = std::chrono::steady_clock::now();
    std::exception_ptr failure;
    try {
      write_record(prepared_->state);
      take_steps();
    } catch (const NumericalError& error) {
      summary_.interrupted = error.what();
      summary_.trust.push_back("the run ended early by a numerical failure");
      failure = std::current_exception();
    }
    summary_.wall_seconds.stepping = seconds_since(stepping_start);
    summary_.wall_seconds.total = seconds_since(start);
    split_wall_time();
    summary_.end_time = prepared_->state.t;
    statistics_->fill(*march_, summary_);
    watch_->fill(prepared_->state, summary_);
    if (!is_first_) write_extremes();
    sink_.finish(summary_);
    if (failure) std::rethrow_exception(failure);
    return summary_;
  }

 private:
  void split_wall_time() {
    const stepping::StepSeconds s = march_->ladder().seconds();
    const double rest = summary_.wall_seconds.stepping - s.large_solves - s.newton - s.completion -
                        recording_seconds_;
    summary_.wall_seconds.phases = {{"large_solves", s.large_solves},
                                    {"newton", s.newton},
                                    {"completion", s.completion},
                                    {"recording", recording_seconds_},
                                    {"coupling_and_rest", rest}};
  }

  /// Equations that hold within a step leave a quasi-static body no shape at its end.
  void check_method() {
    const bool is_within = spec_.method == model::IntegrationMethod::newmark ||
                           spec_.method == model::IntegrationMethod::wilson;
    for (const body::Body& body : built_.model.bodies) {
      if (!body.is_flexible() || !body.flexible->is_quasi_static) continue;
      has_quasi_static_ = true;
      if (!is_within) continue;
      throw InputError(spec_.where,
                       fmt::format("simulation: method {} satisfies the equations within a step, "
                                   "the shape of the quasi-static body \"{}\" at its end would be "
                                   "unknown; use generalized-alpha or hht",
                                   stepping::to_string(method_of(spec_.method)), body.name));
    }
  }

  void set_up() {
    check_method();
    plan_ = plan_output(built_.description);
    summary_.title = built_.model.title;
    summary_.version = kVersion;
    metric_.emplace(built_.model);
    prepared_.emplace(prepare(built_, *metric_));
    const stepping::MarchSettings march = march_settings(spec_);
    stepping::StepSettings settings = step_settings(spec_);
    settings.threads = options_.threads;
    settings.exchange = options_.exchange;
    march_.emplace(built_.model, settings, prepared_->rows_in_use, march);
    if (!march.tolerance) steps_ = march.longest_steps;
    recorder_.emplace(built_, *metric_, !prepared_->redundant_rows.empty());
    fields_.emplace(built_);
    work_.emplace(built_.model, prepared_->state, march_->stepper().scheme().weight == 1.0);
    drives_.emplace(built_.description);
    statistics_.emplace(built_);
    watch_.emplace(built_.model, *metric_, prepared_->rows_in_use);
    summary_.redundant_constraints = prepared_->redundant_text;
    summary_.warnings = prepared_->notes;
    for (std::string& text : drives_->corners(spec_.duration)) {
      summary_.warnings.push_back(std::move(text));
    }
    advise_on_step();
    const double bytes = plan_.bytes(recorder_->layout(), fields_->layout());
    if (const std::string advice = judge_size(bytes); !advice.empty()) {
      summary_.warnings.push_back(advice);
    }
    watch_->start(march_->stepper(), prepared_->state);
    for (const std::string& warning : summary_.warnings) {
      if (options_.tells_warnings) base::log(base::LogLevel::warning, warning);
    }
    results::Geometry geometry = recorder_->geometry();
    if (!fields_->is_empty()) {
      fields_->add_places(geometry);
      sink_.begin_fields(fields_->layout());
    }
    sink_.begin(recorder_->layout(), geometry);
  }

  void advise_on_step() {
    for (const model::WholeBody& whole : built_.model.wholes) {
      for (int b = whole.first; b < whole.first + whole.count; ++b) {
        const body::Body& body = built_.model.bodies[static_cast<std::size_t>(b)];
        if (!body.is_flexible()) continue;
        // Beyond this size the free vibrations cost factorisations of their own: `check` has them.
        if (body.num_dofs() > kAdvisedDofs) {
          set_lowest_frequency(b, march_->stepper().lowest_frequency(static_cast<std::size_t>(b)));
          continue;
        }
        const ExcitedBand band = excited_band(body);
        set_lowest_frequency(b, band.first);
        if (!whole.is_divided()) advise(whole.name, band);
      }
      if (whole.is_divided() && whole.mesh->M.rows() <= kAdvisedDofs) {
        advise(whole.name, excited_band(built_.model, whole));
      }
    }
  }

  void advise(const std::string& body, const ExcitedBand& band) {
    if (march_->is_controlled()) return;
    const std::string advice = judge_step(body, band, march_->longest_step());
    if (!advice.empty()) summary_.warnings.push_back(advice);
  }

  void set_lowest_frequency(int body, double omega) {
    statistics_->set_lowest_frequency(static_cast<std::size_t>(body), omega);
    watch_->set_lowest_frequency(static_cast<std::size_t>(body), omega);
  }

  void take_steps() {
    model::State& state = prepared_->state;
    model::State before;
    if (!report_progress(0)) return;
    for (long step = 1; !march_->is_done(); ++step) {
      std::swap(before, state);
      const stepping::StepReport report = take_step(before, state);
      statistics_->add_step(report, state);
      work_->add(state);
      if (fields_->watches_steps()) fields_->watch(state);
      write_records(before, march_->is_done());
      watch_->after_step(march_->stepper(), state);
      if (!report_progress(step) && !march_->is_done()) return;
    }
    summary_.finished = true;
    summary_.interrupted.clear();
  }

  /// @throws NumericalError; `after` is then as `before`
  stepping::StepReport take_step(const model::State& before, model::State& after) {
    const double reach = std::min(before.t + march_->longest_step(), spec_.duration);
    try {
      const stepping::StepReport report = march_->advance(before, after);
      drives_->check(before.t, after.t);
      // The step has closed velocities with the shapes that quasi-static bodies had at its start.
      if (has_quasi_static_) project_velocities(built_.model, *metric_, after);
      return report;
    } catch (const NumericalError&) {
      after = before;
      // A law that jumps makes any step fail, and says more than the joint that gave way.
      drives_->check(before.t, reach);
      throw;
    }
  }

  bool report_progress(long step) {
    if (!options_.on_progress) return true;
    const bool go_on = options_.on_progress({prepared_->state.t, spec_.duration, step, steps_});
    if (!go_on) summary_.interrupted = options_.stop_reason;
    return go_on;
  }

  /// Records due between two states, interpolated where steps do not fall on them.
  void write_records(const model::State& before, bool is_last) {
    const model::State& after = prepared_->state;
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
          first = {dynamics::energy(built_.model, before), work_->work_before()};
          last = {dynamics::energy(built_.model, after), work_->work()};
        }
        const double share = (t - before.t) / (after.t - before.t);
        write_record(results::interpolate(before, after, t),
                     results::interpolate(*first, *last, share));
      }
    }
    if (is_last && last_written_ < after.t - near) {
      model::State state = after;
      state.lambda = results::multipliers_at(before, after, after.t);
      write_record(state);
    }
  }

  double next_record() const { return static_cast<double>(records_) * plan_.every; }

  /// @param levels energies and work in place of those of the state
  void write_record(const model::State& state,
                    const std::optional<results::EnergyLevels>& levels = {}) {
    const auto start = std::chrono::steady_clock::now();
    const results::Record record = levels ? recorder_->record(state, levels->work, levels->energy)
                                          : recorder_->record(state, work_->work());
    const dynamics::Energy& e = recorder_->last_energy();
    const double scale = std::max(e.kinetic + e.strain + e.springs, work_->turnover());
    statistics_->add_record(state, recorder_->last_balance(), scale);
    sink_.write(record);
    write_fields(state);
    last_written_ = state.t;
    recording_seconds_ += seconds_since(start);
  }

  /// @pre the record of this instant is written
  void write_fields(const model::State& state) {
    if (fields_->is_empty()) return;
    const bool is_end = state.t >= (1.0 - 1e-9) * spec_.duration;
    if (is_first_ || is_end || records_ % plan_.fields_stride == 0) {
      sink_.write_fields(fields_->record(state, {{}, &recorder_->last_multipliers(), 1.0}));
    } else if (fields_->has_extremes()) {
      fields_->watch(state);
    }
    if (seconds_since(extremes_written_) > kSecondsBetweenExtremes) write_extremes();
    is_first_ = false;
  }

  void write_extremes() {
    if (!fields_->has_extremes()) return;
    sink_.write_extremes(fields_->extremes());
    extremes_written_ = std::chrono::steady_clock::now();
  }

  const model::BuiltModel& built_;
  results::RecordSink& sink_;
  const SimulationOptions& options_;
  const model::SimulationSpec& spec_;
  std::optional<dynamics::MassMetric> metric_;
  std::optional<Prepared> prepared_;
  std::optional<stepping::TimeMarch> march_;
  std::optional<DriveLaws> drives_;
  std::optional<results::Recorder> recorder_;
  std::optional<results::FieldRecorder> fields_;
  std::chrono::steady_clock::time_point extremes_written_ = std::chrono::steady_clock::now();
  bool is_first_ = true;  // no fields are written yet
  std::optional<WorkAccount> work_;
  std::optional<RunStatistics> statistics_;
  std::optional<CouplingWatch> watch_;
  results::RunSummary summary_;
  long steps_ = 0;  // 0 where step control leaves that open
  OutputPlan plan_;
  long records_ = 1;  // the state at t = 0 is written before the first step
  double last_written_ = 0;
  bool has_quasi_static_ = false;
  double recording_seconds_ = 0;
};

}  // namespace

results::RunSummary simulate(const model::BuiltModel& built, results::RecordSink& sink,
                             const SimulationOptions& options) {
  if (!built.description.simulation) {
    throw InputError(built.description.where,
                     "there is nothing to run: the model has no `simulation:`; add for example "
                     "`simulation: {duration: 1 s, step: 1 ms}`");
  }
  return Simulation(built, sink, options).run();
}

}  // namespace buckens::analysis
