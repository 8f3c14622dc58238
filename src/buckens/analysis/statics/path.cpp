// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/path.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/initial/assembly_moves.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/analysis/simulation/step_traffic.h"
#include "buckens/analysis/statics/continuation.h"
#include "buckens/analysis/statics/descent.h"
#include "buckens/analysis/statics/equilibrium.h"
#include "buckens/analysis/statics/path_record.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/base/errors.h"
#include "buckens/base/log.h"
#include "buckens/base/version.h"
#include "buckens/model/build/paired_model.h"

namespace buckens::analysis {

using model::StaticMethod;
using model::StaticSpec;

namespace {

constexpr double kShortestStep = 1.0 / 4096;  // of a full step
constexpr double kSharpTurn = 0.7;            // cosine; the step is repeated at half its length
constexpr double kSlightTurn = 0.9;           // the next step is not made longer
constexpr int kIdealIterations = 4;
constexpr int kMostRefinements = 40;
constexpr int kMostCorners = 10;  // within one step

bool have_same_rows(const RestStands& a, const RestStands& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return one.regime == other.regime; });
}

/// One static path from start to end.
class Path {
 public:
  Path(const model::BuiltModel& built, results::RecordSink& sink, const StaticPathOptions& options)
      : paired_(built),
        built_(paired_.built()),
        model_(built_.model),
        options_(options),
        spec_(built.description.static_path.value_or(StaticSpec{})),
        metric_(model_),
        compliances_(model_),
        placed_(assemble()),
        rest_(model_, spec_.friction, placed_, paired_.pairs()),
        record_(built_, metric_, rest_, compliances_, spec_.time, sink) {
    record_.summary.warnings = std::move(notes_);
  }

  results::RunSummary run() {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    results::RunSummary& summary = record_.summary;
    summary.title = model_.title;
    summary.version = kVersion;
    set_up();
    summary.wall_seconds.setup = seconds();
    std::exception_ptr failure;
    try {
      record_.write(*now_);
      trace();
    } catch (const NumericalError& error) {
      summary.interrupted = error.what();
      summary.trust.push_back("the path ended early");
      failure = std::current_exception();
    }
    summary.wall_seconds.total = seconds();
    summary.wall_seconds.stepping = summary.wall_seconds.total - summary.wall_seconds.setup;
    add_traffic(traffic_before_, summary);
    record_.finish(now_->point.load_factor);
    if (failure) std::rethrow_exception(failure);
    return summary;
  }

 private:
  model::State assemble();
  void set_up();
  StaticPoint find_start();
  void refuse_mechanism(StaticDescent& descent, double load_factor) const;
  void check_loads(const StaticPoint& start) const;
  void trace();
  bool turn_corner();
  PathPoint next_point();
  bool take(const PathPoint& next);
  std::optional<PathPoint> refine(const PathPoint& origin, const PathPoint& from,
                                  const PathPoint& to,
                                  const std::function<double(PathPoint&)>& value, double tolerance);
  std::vector<PathPoint> critical_points(const PathPoint& found);
  std::optional<PathPoint> end_between(const PathPoint& origin, const PathPoint& from,
                                       const PathPoint& to);
  void examine(PathPoint& at);
  bool report(const PathPoint& at, double step);

  double range() const { return spec_.load_factor[1] - spec_.load_factor[0]; }

  model::PairedModel paired_;
  const model::BuiltModel& built_;
  const model::Model& model_;
  const StaticPathOptions& options_;
  StaticSpec spec_;
  dynamics::MassMetric metric_;
  const linalg::Traffic traffic_before_ = linalg::Ranks::traffic();
  Compliances compliances_;
  std::vector<std::string> notes_;  // of assembly
  model::State placed_;
  RestRows rest_;
  StaticPathRecord record_;
  std::optional<StaticContinuation> continuation_;
  std::optional<PathPoint> now_;
  double reference_ = 1;  // relevant stiffness [1/s²]
  double step_ = 1;       // length of the next step, in full steps
  int points_ = 1;
};

void Path::set_up() {
  const StaticPoint start = find_start();
  check_loads(start);
  StaticPoint loaded = start;
  loaded.load_factor = std::max(std::abs(spec_.load_factor[0]), std::abs(spec_.load_factor[1]));
  const PathScale scale{std::abs(range()) / spec_.steps, spec_.arc_step,
                        spec_.method == StaticMethod::load};
  continuation_.emplace(model_, metric_, rest_, compliances_.of_body, spec_.time, scale,
                        strongest_load(model_, rest_, loaded, spec_.time));
  now_ = continuation_->begin(start, range() < 0.0 ? -1.0 : 1.0);
  examine(*now_);
  for (const std::string& text : record_.summary.warnings) {
    base::log(base::LogLevel::warning, text);
  }
  record_.begin(*now_);
}

/// Bodies as placed, with joints closed.
model::State Path::assemble() {
  model::State state = model::placed_state(model_);
  state.t = spec_.time;
  notes_ = built_.description.warnings;
  notes_.insert(notes_.end(), model_.notes.begin(), model_.notes.end());
  bool is_closed = false;
  try {
    assemble_positions(model_, metric_, state);
    is_closed = true;
  } catch (const ModelError&) {
    if (!built_.description.initial.preload) throw;
    notes_.push_back("bodies are deformed to close the joints (preload)");
  }
  if (is_closed) {
    for (std::string& text : judge_assembly(built_, assembly_moves(model_, state))) {
      notes_.push_back(std::move(text));
    }
  }
  return state;
}

StaticPoint Path::find_start() {
  StaticPoint start = static_point(model_, rest_, placed_);
  start.load_factor = spec_.load_factor[0];
  StaticDescent descent(model_, metric_, rest_, compliances_.of_body, spec_.time, std::move(start));
  std::vector<std::string>& notes = record_.summary.warnings;
  for (std::string& text : rest_.overlaps(descent.balance().rest)) notes.push_back(std::move(text));
  StaticReport report;
  settle_statically(model_, descent, report);
  refuse_mechanism(descent, spec_.load_factor[0]);
  notes.insert(notes.end(), report.notes.begin(), report.notes.end());
  reference_ = descent.reference();
  return descent.point();
}

void Path::refuse_mechanism(StaticDescent& descent, double load_factor) const {
  auto modes = descent.modes();
  if (!modes) modes = descent.softest();
  if (!modes || modes->stiffness.size() == 0 || modes->stiffness[0] > modes->tolerance) return;
  Eigen::Index count = 0;
  while (count < modes->stiffness.size() && modes->stiffness[count] <= modes->tolerance) ++count;
  throw ModelError(fmt::format(
      "no static path: at load factor {:.6g} {} without any restoring force{}; hold it by a joint "
      "or a spring, {}or begin at a load factor at which the load holds it "
      "(static: {{load-factor: [first, last]}})",
      load_factor, describe_motion(model_, descent.system(), descent.point(), modes->shapes.col(0)),
      count == 1 ? "" : fmt::format(", one of {} such motions", count),
      rest_.leaves_friction() ? "or hold what rubs (static: {friction: frozen}), " : ""));
}

void Path::check_loads(const StaticPoint& start) const {
  StaticPoint loaded = start;
  loaded.load_factor = 1.0;
  StaticPoint unloaded = start;
  unloaded.load_factor = 0.0;
  const StaticSystem system(model_, rest_, compliances_.of_body, {}, spec_.time, 1.0);
  const auto with = system.balance(loaded).forces;
  const auto without = system.balance(unloaded).forces;
  for (std::size_t b = 0; b < with.frame.size(); ++b) {
    if (with.frame[b] != without.frame[b] || with.interface[b] != without.interface[b]) return;
  }
  throw InputError(
      spec_.where.file.empty() ? built_.description.where : spec_.where,
      fmt::format("there is no load that a load factor could multiply: applied forces and torques "
                  "are absent or zero at t = {:.6g} s; add one under `loads`, or name with "
                  "`static: {{time: …}}` an instant at which they act",
                  spec_.time));
}

void Path::trace() {
  results::RunSummary& summary = record_.summary;
  if (!report(*now_, 0.0)) return;
  while (points_ < spec_.max_points) {
    const double before = now_->position;
    const PathPoint next = next_point();
    ++points_;
    const bool ended = take(next);
    if (ended || record_.passed_stop()) {
      summary.finished = true;
      summary.interrupted.clear();
      report(*now_, now_->position - before);
      return;
    }
    if (!report(*now_, now_->position - before)) return;
  }
  summary.interrupted = fmt::format(
      "{} points were reached before the end of the path (static: max-points)", points_);
}

bool Path::report(const PathPoint& at, double step) {
  if (!options_.on_progress) return true;
  const bool go_on = options_.on_progress({points_, at.point.load_factor, step, at.iterations});
  if (!go_on && !record_.summary.finished) record_.summary.interrupted = options_.stop_reason;
  return go_on;
}

/// Goes on from where a row opens or closes, if that is what ends the path here.
bool Path::turn_corner() {
  std::optional<PathPoint> corner = continuation_->around_corner(*now_);
  if (!corner) return false;
  corner->stiffness.reset();  // it jumps here
  const bool turns_back = corner->load_rate * now_->load_rate < 0.0;
  if (turns_back) corner->kind = "limit point";
  record_.write(*corner);
  if (turns_back) record_.add_critical_point(*corner);
  now_ = std::move(*corner);
  now_->kind.clear();
  step_ = 0.125;
  return true;
}

/// One step, shortened until Newton gets there without a sharp turn of the path.
PathPoint Path::next_point() {
  continuation_->look_around(*now_);
  bool has_new_rows = false;
  int corners = 0;
  for (;;) {
    double step = step_;
    if (spec_.method == StaticMethod::load) {
      // Steps end on multiples of a full one.
      step = std::min(step, std::floor(now_->position + 1.0 + 1e-9) - now_->position);
    }
    std::optional<PathPoint> next = continuation_->ahead(*now_, step);
    if (next && spec_.method == StaticMethod::arc_length) {
      const double cosine = continuation_->alignment(*now_, *next);
      if (cosine < kSharpTurn && step > 16 * kShortestStep) next.reset();
      if (next && cosine < kSlightTurn) step_ *= 0.5;
    }
    if (next) {
      const double ratio =
          std::sqrt(static_cast<double>(kIdealIterations) / std::max(1, next->iterations));
      step_ = std::clamp(step_ * std::clamp(ratio, 0.5, 2.0), kShortestStep, 1.0);
      return std::move(*next);
    }
    step_ = 0.5 * step;
    if (step_ >= kShortestStep) continue;
    if (corners < kMostCorners && turn_corner()) {
      ++corners;
      continue;
    }
    std::optional<PathPoint> anew;
    if (!has_new_rows) anew = continuation_->with_new_rows(*now_);
    if (!anew) break;
    has_new_rows = true;
    step_ = 0.125;
    anew->position = now_->position;
    now_ = std::move(*anew);
  }
  const char* remedy = spec_.method == StaticMethod::load
                           ? "perhaps this is a limit point: `method: arc-length` goes beyond it"
                           : "a smaller `arc-step`, more `steps`, or another start may help";
  throw NumericalError(
      fmt::format("the static path cannot be followed beyond load factor {:.9g}, however short the "
                  "step: {}; {}",
                  now_->point.load_factor, continuation_->resisting(), remedy));
}

/// Writes the points up to and including `next`; true at the last load factor.
bool Path::take(const PathPoint& found) {
  PathPoint next = found;
  examine(next);
  std::vector<PathPoint> stations = critical_points(next);
  stations.push_back(std::move(next));
  const PathPoint origin = *now_;
  for (std::size_t k = 0; k < stations.size(); ++k) {
    PathPoint& station = stations[k];
    if (auto end = end_between(origin, *now_, station)) {
      examine(*end);
      now_ = std::move(*end);
      continuation_->fit(*now_);
      record_.write(*now_);
      return true;
    }
    continuation_->fit(station);
    record_.write(station);
    if (k + 1 < stations.size()) record_.add_critical_point(station);
    now_ = station;
  }
  return false;
}

void Path::examine(PathPoint& at) {
  constexpr Eigen::Index kMostFrameCoordinates =
      300;  // beyond, eigenvalues cost more than the step
  Eigen::Index frame = 0;
  for (const body::Body& body : model_.bodies) {
    frame += body.rotation_basis.cols() + body.translation_basis.cols();
  }
  at.stiffness.reset();
  if (frame > kMostFrameCoordinates) return;
  if (const auto modes = continuation_->modes(at, reference_)) at.stiffness = modes->stiffness;
}

/// A point between two others, both reached from `origin`, at which `value` is zero, if they differ
/// in its sign.
std::optional<PathPoint> Path::refine(const PathPoint& origin, const PathPoint& from,
                                      const PathPoint& to,
                                      const std::function<double(PathPoint&)>& value,
                                      double tolerance) {
  PathPoint a = from;
  PathPoint b = to;
  double f_a = value(a);
  double f_b = value(b);
  if (!(f_a * f_b < 0.0)) return std::nullopt;
  double s_a = from.position - origin.position;
  double s_b = to.position - origin.position;
  std::optional<PathPoint> best;
  for (int round = 0; round < kMostRefinements; ++round) {
    const double s = round % 8 == 7 ? 0.5 * (s_a + s_b) : (s_a * f_b - s_b * f_a) / (f_b - f_a);
    std::optional<PathPoint> middle = continuation_->ahead(origin, s, true);
    if (!middle) return best;
    const double f = value(*middle);
    best = std::move(middle);
    if (std::abs(f) <= tolerance || std::abs(s_b - s_a) < 1e-13) return best;
    if (f * f_b < 0.0) {
      s_a = s_b;
      f_a = f_b;
    } else {
      f_a *= 0.5;  // Illinois' rule: no end stays forever
    }
    s_b = s;
    f_b = f;
  }
  return best;
}

std::vector<PathPoint> Path::critical_points(const PathPoint& found) {
  std::vector<PathPoint> out;
  if (spec_.method == StaticMethod::load) return out;
  const double full = std::abs(range()) / spec_.steps;
  PathPoint from = *now_, next = found;
  continuation_->fit(from);
  continuation_->fit(next);
  bool has_limit = false;
  if (from.load_rate * next.load_rate < 0.0) {
    auto limit = refine(
        from, from, next, [](PathPoint& at) { return at.load_rate; }, 1e-10 * full);
    if (limit) {
      examine(*limit);
      limit->kind = "limit point";
      out.push_back(std::move(*limit));
      has_limit = true;
    }
  }
  if (!from.stiffness || !next.stiffness || from.stiffness->size() != next.stiffness->size()) {
    return out;
  }
  if (!have_same_rows(from.point.rest, next.point.rest)) return out;  // they change it at once
  const auto unstable = [](const PathPoint& at) { return (at.stiffness->array() < 0.0).count(); };
  const auto fewer = std::min(unstable(from), unstable(next));
  const auto change = std::abs(unstable(from) - unstable(next));
  if (change <= (has_limit ? 1 : 0)) return out;
  // Of several that change, the last; a limit point among them is not distinguished from a
  // bifurcation.
  const auto index = fewer + change - 1;
  const double tolerance = 1e-9 * std::abs((*from.stiffness)[index] - (*next.stiffness)[index]);
  auto branching = refine(
      from, from, next,
      [&](PathPoint& at) {
        examine(at);
        return at.stiffness && at.stiffness->size() > index ? (*at.stiffness)[index] : 0.0;
      },
      tolerance);
  if (!branching) return out;
  branching->kind = "bifurcation";
  out.push_back(std::move(*branching));
  std::sort(out.begin(), out.end(),
            [](const PathPoint& a, const PathPoint& b) { return a.position < b.position; });
  return out;
}

std::optional<PathPoint> Path::end_between(const PathPoint& origin, const PathPoint& from,
                                           const PathPoint& to) {
  const double last = spec_.load_factor[1];
  const auto missing = [last](PathPoint& at) { return at.point.load_factor - last; };
  const double near = 1e-12 * std::abs(range());
  PathPoint end = to;
  if (std::abs(missing(end)) > near) {
    PathPoint start = from;
    if (missing(start) * missing(end) > 0.0) return std::nullopt;
    auto between = refine(origin, from, to, missing, near);
    if (!between) return std::nullopt;
    end = std::move(*between);
  }
  // Exactly there, unless it is a limit point.
  if (auto exact = continuation_->at_load_factor(end, last)) {
    exact->load_rate = end.load_rate;
    exact->direction = end.direction;
    exact->iterations = end.iterations;
    return exact;
  }
  return end;
}

}  // namespace

results::RunSummary trace_static_path(const model::BuiltModel& built, results::RecordSink& sink,
                                      const StaticPathOptions& options) {
  return Path(built, sink, options).run();
}

}  // namespace buckens::analysis
