// SPDX-License-Identifier: Apache-2.0
// What a run checks and prepares before its first step.
#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "buckens/analysis/simulation/run.h"
#include "buckens/analysis/simulation/seconds_since.h"
#include "buckens/analysis/simulation/settings.h"
#include "buckens/analysis/simulation/step_advice.h"
#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/base/free_memory.h"
#include "buckens/base/log.h"
#include "buckens/base/timed_phase.h"
#include "buckens/base/version.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

namespace {

constexpr Eigen::Index kAdvisedDofs = 600;
// Blows on 64, 216 and 512 balls in a lattice take 0.06, 0.7 and 30 s.
constexpr std::size_t kManyRough = 250;
// How far a sample time may be from whole steps: rounding of a division.
constexpr double kWholeSteps = 1e-6;

/// What takes long in rigid contact groups; empty: nothing.
std::string judge_group(const model::Model& model, const model::ContactGroup& group) {
  const std::size_t count = group.members.size();
  if (!group.rigid || group.rigid->static_coefficient == 0.0 || count <= kManyRough) return {};
  return fmt::format(
      "load \"{}\": {} shapes without a stiffness, but with friction: where as many press each "
      "other at once, a step may take from seconds to minutes; give them a `stiffness`, whose "
      "steps are shorter, but cost little, or leave out `static`",
      model.loads[group.load].name, count);
}

/// A load that holds rigidly, or may; null: none.
const model::Load* rigid_load(const model::Model& model) {
  for (const model::Load& load : model.loads) {
    if (load.rigid_row >= 0) return &load;
  }
  for (const auto& group : model.contact_groups) {
    if (group->rigid) return &model.loads[group->load];
  }
  return nullptr;
}

}  // namespace

/// Equations that hold within a step determine neither a quasi-static shape at its end nor whether
/// the set of a rigid row admits its force there.
void SimulationRun::check_method() {
  const bool is_within = spec_.method == model::IntegrationMethod::newmark ||
                         spec_.method == model::IntegrationMethod::wilson;
  const model::Load* const rigid = rigid_load(built_.model);
  if (is_within && rigid != nullptr) {
    throw InputError(spec_.where,
                     fmt::format("simulation: method {} satisfies the equations within a step, not "
                                 "at its end, where {} \"{}\" holds rigidly; use "
                                 "generalized-alpha or hht, or {}",
                                 stepping::to_string(method_of(spec_.method)),
                                 rigid->is_among_joints ? "joint" : "load", rigid->name,
                                 rigid->is_among_joints ? "an `elastic-gear` in its place"
                                                        : "give the load a stiffness"));
  }
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

/// Where the model gives no longest step, the shortest sample time is a whole number of it.
void SimulationRun::fit_to_samples(stepping::MarchSettings& march) const {
  if (!march.tolerance || spec_.step.value_or(0.0) > 0.0) return;
  double shortest = HUGE_VAL;
  for (const model::Signal& signal : built_.model.signals.all) {
    if (signal.is_sampled()) shortest = std::min(shortest, signal.block->sample_time());
  }
  const double samples = std::round((march.duration - march.start) / shortest);
  if (!(samples >= 1.0 && std::isfinite(samples))) return;
  const double steps_of_one = std::ceil(static_cast<double>(march.longest_steps) / samples);
  march.longest_steps = std::lround(steps_of_one * samples);
}

/// Sampled signals are read at the ends of steps.
void SimulationRun::check_samples() const {
  const double step = march_->longest_step();
  const double begin = march_start_ / step;
  for (const model::Signal& signal : built_.model.signals.all) {
    if (!signal.is_sampled()) continue;
    const double T = signal.block->sample_time();
    const double steps = T / step;
    if (std::abs(begin - std::round(begin)) > kWholeSteps) {
      throw InputError(signal.where,
                       fmt::format("signal \"{}\": a run that goes on from t = {:.9g} s with steps "
                                   "of {:.6g} s misses its samples; use a step of which that time "
                                   "is a multiple",
                                   signal.name, march_start_, step));
    }
    if (steps > 0.5 && std::abs(steps - std::round(steps)) <= kWholeSteps) continue;
    throw InputError(
        signal.where,
        fmt::format("signal \"{}\": its sample time of {:.6g} s is {:.6g} steps of "
                    "{:.6g} s (the duration is a whole number of steps), but it has to "
                    "be a whole number; change `sample`, the step or the duration",
                    signal.name, T, steps, step));
  }
}

/// Factorises for a grid of steps from this instant to the end.
void SimulationRun::begin_march(double start) {
  march_start_ = start;
  stepping::MarchSettings march = march_settings(spec_, start);
  fit_to_samples(march);
  if (powers_->any()) march.most_halvings = stepping::TimeMarch::kShortestRung;
  stepping::StepSettings settings = step_settings(spec_);
  settings.threads = options_.threads;
  settings.pool = pool_.get();
  settings.exchange = options_.exchange;
  settings.released = prepared_->released;
  metric_->let_go();
  march_.emplace(built_.model, settings, prepared_->rows_in_use, march);
  jump_.emplace(built_.model);  // it keeps what belongs to the steppers of a march
  steps_ = march.tolerance ? 0 : steps_taken_ + march.longest_steps;
  check_samples();
}

void SimulationRun::set_up() {
  if (options_.threads > 1) pool_ = std::make_unique<TaskPool>(options_.threads);
  const base::AllowedThreads threads(pool_.get());
  check_method();
  plan_ = plan_output(built_.description);
  summary_.title = built_.model.title;
  summary_.version = kVersion;
  {
    const base::TimedPhase phase("initial_state");
    metric_.emplace(built_.model);
    prepared_.emplace(prepare(built_, *metric_, own_.pairs()));
  }
  powers_.emplace(built_.model, method_of(spec_.method) != stepping::Method::newmark);
  begin_march(0.0);
  observer_.emplace(built_, *metric_, !prepared_->redundant_rows.empty(), pool_.get());
  work_.emplace(built_.model, prepared_->state, march_->stepper().scheme().weight == 1.0);
  readings_.emplace(built_, *observer_);
  readings_->start(*observer_, work_->work(), prepared_->state);
  has_samples_ = built_.model.signals.have_samples();
  work_->take_jump(prepared_->state);
  drives_.emplace(built_.description);
  shafts_.emplace(built_.model);
  growth_.emplace(built_.model);
  reading_growth_.emplace(built_.model);
  events_.emplace(built_);
  actions_.emplace(built_, *metric_);
  statistics_.emplace(built_, pool_.get());
  watch_.emplace(built_.model, *metric_, prepared_->rows_in_use);
  summary_.redundant_constraints = prepared_->redundant_text;
  note_solvers();
  for (const std::string& text : prepared_->warnings) warn(text);
  for (const AssemblyMove& move : prepared_->moves) {
    if (!move.is_large) summary_.notes.push_back(move.text());
  }
  for (const std::string& text : prepared_->notes) warn(text);
  for (const auto& group : built_.model.contact_groups) {
    if (const std::string text = judge_group(built_.model, *group); !text.empty()) warn(text);
  }
  for (const std::string& text : drives_->check_start(spec_.duration)) warn(text);
  for (const std::string& text : drives_->corners(spec_.duration)) warn(text);
  advise_on_step();
  watch_->start(march_->stepper(), prepared_->state);
}

/// How bodies are solved whose solver was left to the program.
void SimulationRun::note_solvers() {
  for (const model::WholeBody& whole : built_.model.wholes) {
    const std::string why = march_->stepper().why_solver(static_cast<std::size_t>(whole.first));
    if (why.empty()) continue;
    summary_.notes.push_back(fmt::format("body \"{}\": `solver: auto` is {}", whole.name, why));
    base::log(base::LogLevel::info, summary_.notes.back());
  }
}

void SimulationRun::advise_on_step() {
  for (const model::WholeBody& whole : built_.model.wholes) {
    for (int b = whole.first; b < whole.first + whole.count; ++b) {
      const body::Body& body = built_.model.bodies[static_cast<std::size_t>(b)];
      if (!body.is_flexible()) continue;
      // Beyond this size the free vibrations need extra factorisations: `check` has them.
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

void SimulationRun::advise(const std::string& body, const ExcitedBand& band) {
  if (march_->is_controlled()) return;
  const std::string advice = judge_step(body, band, march_->longest_step(), plan_.finest);
  if (!advice.empty()) warn(advice);
}

void SimulationRun::set_lowest_frequency(int body, double omega) {
  const std::string& name =
      built_.model.wholes[static_cast<std::size_t>(built_.model.whole_of(body))].name;
  if (const std::string doubt = judge_frequency(name, omega); !doubt.empty()) warn(doubt);
  statistics_->set_lowest_frequency(static_cast<std::size_t>(body), omega);
  watch_->set_lowest_frequency(static_cast<std::size_t>(body), omega);
}

void SimulationRun::record_into(results::RecordSink& sink) {
  const auto start = Clock::now();
  base::take_phases();  // of a change of state in between, which is no set-up
  std::optional<base::TimedPhase> phase(std::in_place, "records");
  recording_.emplace(RunRecording::Followed{built_, *work_, *statistics_, *observer_, pool_.get()},
                     plan_, sink);
  if (restored_) {
    const base::SaveVisit visit = base::SaveVisit::restoring(*restored_).inside("recording");
    if (restored_->counts.contains("recording/records")) {
      recording_->visit_saved(visit);
    } else {
      recording_->skip_to(state().t);
    }
    restored_.reset();
  }
  if (const std::string advice = recording_->size_advice(); !advice.empty()) warn(advice);
  recording_->begin();
  base::return_free_memory();
  phase.reset();
  note_preparation(seconds_since(start));
}

/// Sensors refer to the state at which they are first evaluated.
void SimulationRun::begin_records() {
  if (has_begun_) return;
  has_begun_ = true;
  if (recording_) return recording_->write_start(prepared_->state);
  observer_->record(prepared_->state, work_->work());
}

}  // namespace buckens::analysis
