// SPDX-License-Identifier: Apache-2.0
// What a simulation shows, accepts and saves between steps.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/initial/rigid_rows_start.h"
#include "buckens/analysis/simulation/run.h"
#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/base/version.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/signals.h"
#include "buckens/model/function_signal.h"
#include "buckens/model/saved_state.h"
#include "buckens/model/spec/field_lines.h"
#include "buckens/results/state_interpolation.h"

namespace buckens::analysis {

namespace {

constexpr double kSameEnd = 1e-9;  // ends of steps are counted
constexpr long kMostEver = 1L << 60;
constexpr std::size_t kMostDifferences = 3;

/// "bodies.rod.mass: 1" split at the first ": ".
std::pair<std::string, std::string> split_line(const std::string& line) {
  const std::size_t at = line.find(": ");
  if (at == line.npos) return {line, ""};
  return {line.substr(0, at), line.substr(at + 2)};
}

/// The first few differences of two lists of lines.
std::string differences(const std::vector<std::string>& saved,
                        const std::vector<std::string>& here) {
  std::vector<std::string> out;
  const auto tell = [&](const std::vector<std::string>& mine, const std::vector<std::string>& other,
                        bool is_saved) {
    for (const std::string& line : mine) {
      if (std::find(other.begin(), other.end(), line) != other.end()) continue;
      const auto [path, value] = split_line(line);
      const auto same = std::find_if(
          other.begin(), other.end(),
          [&, path = path](const std::string& o) { return split_line(o).first == path; });
      if (same != other.end() && !is_saved) continue;  // told already
      const std::string there = same == other.end() ? "missing" : split_line(*same).second;
      out.push_back(fmt::format("{} was {}, is {}", path, is_saved ? value : "missing",
                                is_saved ? there : value));
    }
  };
  tell(saved, here, true);
  tell(here, saved, false);
  const std::size_t more = out.size() > kMostDifferences ? out.size() - kMostDifferences : 0;
  out.resize(out.size() - more);
  return fmt::format("{}{}", fmt::join(out, "; "),
                     more > 0 ? fmt::format("; and {} more", more) : "");
}

/// Lines of a model without values that do not matter.
std::vector<std::string> without(const std::vector<std::string>& lines,
                                 const std::vector<std::string>& paths) {
  std::vector<std::string> out;
  for (const std::string& line : lines) {
    const std::string path = split_line(line).first;
    if (std::find(paths.begin(), paths.end(), path) == paths.end()) out.push_back(line);
  }
  return out;
}

bool have_in_common(const std::vector<std::string>& a, const std::vector<std::string>& b,
                    const std::string& path) {
  const auto line_of = [&](const std::vector<std::string>& lines) {
    const auto is_it = [&](const std::string& line) { return split_line(line).first == path; };
    return std::find_if(lines.begin(), lines.end(), is_it);
  };
  const auto in_a = line_of(a), in_b = line_of(b);
  return in_a != a.end() && in_b != b.end() && *in_a == *in_b;
}

constexpr char kLongestStepLine[] = "longest step";
const std::vector<std::string> kFreeSteps = {"simulation.step", "simulation.tolerance",
                                             "simulation.absolute-tolerance", kLongestStepLine};

/// @throws InputError if a saved state lies beyond the end of the run
void require_within(double duration, double t) {
  if (t <= duration * (1.0 + kSameEnd)) return;
  throw InputError(
      fmt::format("the state is that at t = {:.9g} s, after the end of the run at t = {:.9g} s; "
                  "give the model a longer simulation.duration",
                  t, duration));
}

}  // namespace

const std::vector<double>& SimulationRun::observe() {
  begin_records();
  if (observed_at_ == steps_taken_) return observed_;
  model::State& state = prepared_->state;
  // λ of a step may refer to an instant within it; records have it at its end.
  linalg::Vector own = state.lambda;
  if (steps_taken_ > 0) state.lambda = results::multipliers_at(before_, state, state.t);
  const results::Record record = observer_->record(state, work_->work());
  std::swap(state.lambda, own);
  observed_.resize(record.values.size());
  std::copy(record.values.begin(), record.values.end(), observed_.begin());
  observed_at_ = steps_taken_;
  return observed_;
}

std::vector<std::size_t> SimulationRun::loads_with_values(const std::string& name) const {
  std::vector<std::size_t> out;
  std::vector<std::string> known;
  for (std::size_t k = 0; k < built_.model.loads.size(); ++k) {
    const model::Load& load = built_.model.loads[k];
    if (load.name == name && load.coordinate >= 0) {
      throw InputError(fmt::format(
          "load \"{}\" acts on the coordinate of a joint and takes no value from outside; "
          "let it follow a signal with a `setting`, which can be set",
          name));
    }
    if (!load.element->takes_values()) continue;
    known.push_back(load.name);
    if (load.name == name) out.push_back(k);
  }
  if (!out.empty()) return out;
  if (known.empty()) {
    throw InputError(
        fmt::format("no load \"{}\" takes a value from outside: the model has neither "
                    "forces nor torques; add `force: {{on: …, value: [0, 0, 0]}}`",
                    name));
  }
  throw InputError(fmt::format("no load \"{}\" takes a value from outside.{}", name,
                               base::suggestion(name, known)));
}

void SimulationRun::set_load(const std::string& name, const std::optional<Eigen::Vector3d>& value) {
  if (value && !value->allFinite()) {
    throw InputError(fmt::format("load \"{}\": its value [{}, {}, {}] is not finite", name,
                                 value->x(), value->y(), value->z()));
  }
  model::State& state = prepared_->state;
  const std::vector<std::size_t> found = loads_with_values(name);
  state.inputs.resize(built_.model.loads.size());
  jump_->note(state);
  for (const std::size_t k : found) state.inputs[k] = value;
  has_new_inputs_ = true;
  observed_at_ = -1;
  if (steps_taken_ > 0) {
    if (carries_accelerations()) jump_->pass(march_->stepper(), state);
    return;
  }
  settle_rigid_rows(built_.model, *metric_, prepared_->rows_in_use, state);
}

std::size_t SimulationRun::find_signal(const std::string& name) const {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < built_.model.signals.all.size(); ++k) {
    known.push_back(built_.model.signals.all[k].name);
    if (known.back() == name) return k;
  }
  if (known.empty()) {
    throw InputError(
        fmt::format("there is no signal \"{}\": the model has none; add `signals: {{{}: {{setting: "
                    "0}}}}` to it",
                    name, name));
  }
  throw InputError(
      fmt::format("there is no signal \"{}\".{}", name, base::suggestion(name, known)));
}

double SimulationRun::signal(const std::string& name) const {
  return prepared_->state.memory.signals[find_signal(name) + 1];
}

void SimulationRun::set_signal(const std::string& name, double value) {
  const model::Signal& signal = built_.model.signals.all[find_signal(name)];
  const auto* spec = base::find_named(built_.description.signals, name);
  if (model::function_of(signal) != nullptr) {
    throw InputError(
        fmt::format("signal \"{}\" is given by a function; let that return the value", name));
  }
  if (!spec->setting) {
    throw InputError(
        fmt::format("signal \"{}\" follows from the motion; only signals with a "
                    "`setting` can be set",
                    name));
  }
  if (name.starts_with("gravity.")) {
    throw InputError(
        fmt::format("\"{}\" is a component of gravity, which events change as a whole; let an "
                    "event set it by formulas of other settings",
                    name));
  }
  if (!std::isfinite(value)) {
    throw InputError(fmt::format("signal \"{}\": its value {} is not finite", name, value));
  }
  model::State& state = prepared_->state;
  const auto follow = [&](const std::vector<dynamics::StateChange>& changes) {
    dynamics::change_states(built_.model, dynamics::motions_of(built_.model, state),
                            dynamics::circumstances_of(state), changes, state.memory);
  };
  jump_->note(state);
  const std::vector<double> signals_before = state.memory.signals;
  follow({{signal.first_state, value}});
  work_->take_jump(state);
  has_new_inputs_ = true;
  observed_at_ = -1;
  if (steps_taken_ > 0) {
    if (!carries_accelerations()) return;
    jump_->pass(march_->stepper(), state);
    work_->take_force_jump(state, signals_before);
    return;
  }
  settle_rigid_rows(built_.model, *metric_, prepared_->rows_in_use, state);
  follow({});  // signals that look at forces
}

std::vector<std::string> SimulationRun::identity() const {
  std::vector<std::string> out = model::field_lines(built_.description);
  for (std::string& line : model::built_lines(built_.model)) out.push_back(std::move(line));
  out.push_back(fmt::format("{}: {:.12g} s", kLongestStepLine, march_->longest_step()));
  return out;
}

void SimulationRun::visit_saved(const base::SaveVisit& visit) {
  model::State& state = prepared_->state;
  if (own_.pairs() != nullptr) {
    std::vector<model::NearPair> near;
    for (const model::PairLoads& loads : built_.model.pair_loads) near.push_back(loads.pair);
    model::visit_pairs(visit.inside("rigid_pairs"), built_.model, true, near);
    if (visit.is_restoring()) own_.pairs()->set(near);
  }
  model::visit_saved(visit.inside("state"), built_.model, state);
  if (own_.pairs() != nullptr && visit.is_restoring()) work_->follow_pairs(state);
  visit.count("steps", steps_taken_, 0, kMostEver);
  visit.flag("has_begun", has_begun_);
  visit.flag("has_new_inputs", has_new_inputs_);
  visit.number("t_before", before_.t);
  visit.vector_or_none("lambda_before", before_.lambda, state.lambda.size());
  visit.number("lambda_time_before", before_.lambda_time);
  work_->visit_saved(visit.inside("work"));
  statistics_->visit_saved(visit.inside("statistics"));
  watch_->visit_saved(visit.inside("coupling"));
  observer_->visit_saved(visit.inside("sensors"));
  growth_->visit_saved(visit.inside("growth"));
  reading_growth_->visit_saved(visit.inside("reading_growth"));
  if (built_.description.events.empty()) return;
  events_->visit_saved(visit.inside("events"));
  visit.texts("told_events", told_events_);
  // An event ends a run of this duration; a longer one goes on.
  double ended = is_at_end_ ? spec_.duration : 0.0;
  visit.number("ended", ended);
  is_at_end_ = spec_.duration <= ended;
}

void SimulationRun::save(const base::SaveVisit& visit) {
  std::vector<std::string> version = {kVersion};
  std::vector<std::string> lines = identity();
  visit.texts("version", version);
  visit.texts("model", lines);
  visit_saved(visit);
  double longest_step = march_->longest_step();
  visit.number("longest_step", longest_step);
  visit.number("march_start", march_start_);
  march_->visit_saved(visit.inside("march"));
  if (recording_) recording_->visit_saved(visit.inside("recording"));
}

void SimulationRun::restore(const base::SavedValues& saved, Leeway leeway) {
  const base::SaveVisit visit = base::SaveVisit::restoring(saved);
  std::vector<std::string> version, lines;
  visit.texts("version", version);
  visit.texts("model", lines);
  if (version != std::vector<std::string>{kVersion}) {
    throw InputError(
        fmt::format("the state was saved by buckens {}, this is {}: a continuation "
                    "would not be the same; use that version, or run from the start",
                    fmt::join(version, ""), kVersion));
  }
  double march_start = 0, longest_step = 0;
  visit.number("march_start", march_start);
  visit.number("longest_step", longest_step);  // for those who cut records; here it is in `lines`
  if (march_start != march_start_) begin_march(march_start);
  std::vector<std::string> here = identity();
  if (have_in_common(lines, here, kLongestStepLine)) {
    // However it was given.
    lines = without(lines, {"simulation.step"});
    here = without(here, {"simulation.step"});
  }
  const auto interval = saved.numbers.find("recording/every");
  if (interval != saved.numbers.end() && interval->second == std::vector{plan_.every}) {
    lines = without(lines, {"output.every"});
    here = without(here, {"output.every"});
  }
  const bool has_other_steps = leeway == Leeway::steps && lines != here &&
                               without(lines, kFreeSteps) == without(here, kFreeSteps);
  if (lines != here && !has_other_steps) {
    throw InputError(
        fmt::format("the state belongs to another model: {}; use the model that it "
                    "was saved with (title and duration may change)",
                    differences(lines, here)));
  }
  visit_saved(visit);
  require_within(spec_.duration, state().t);
  if (has_other_steps) {
    if (state().t >= spec_.duration * (1.0 - kSameEnd)) {
      throw InputError(fmt::format(
          "the state is that at the end of the run, t = {:g} s; give the model a longer "
          "simulation.duration, with --set, or with --until where the run itself goes on",
          state().t));
    }
    begin_march(state().t);
  } else {
    march_->visit_saved(visit.inside("march"));
    // The end of the run before was that of a step, but for rounding.
    if (!march_->is_done()) prepared_->state.t = march_->time();
  }
  if (steps_ > 0 && march_start_ > 0.0) {
    steps_ = steps_taken_ + std::lround((spec_.duration - state().t) / march_->longest_step());
  }
  for (const std::string& text : told_events_) summary_.notes.push_back(text);
  observed_at_ = -1;
  restored_ = saved.part("recording/");
  summary_.notes.push_back(fmt::format("goes on from a state saved at t = {:.6g} s", state().t));
}

}  // namespace buckens::analysis
