// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/event_watch.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/signals.h"
#include "buckens/results/state_interpolation.h"

namespace buckens::analysis {

namespace {

// So many of one kind within so many steps are chatter.
constexpr std::size_t kMostEvents = 20;
constexpr long kWithinSteps = 100;
// Halvings of a step: far below what interpolation is good for.
constexpr int kBisections = 40;

bool crosses(model::Crossing direction, double before, double after) {
  const bool rises = before < 0.0 && after >= 0.0;
  const bool falls = before > 0.0 && after <= 0.0;
  return (rises && direction != model::Crossing::falling) ||
         (falls && direction != model::Crossing::rising);
}

/// Whether a signal is one read at the ends of steps, or a formula of such.
bool hangs_on_reading(const std::vector<model::Signal>& all, std::size_t k) {
  const model::Signal& signal = all[k];
  if (signal.held) return true;
  if (signal.kind != model::Signal::Kind::formula) return false;
  return std::any_of(signal.input.places.begin(), signal.input.places.end(), [&](int other) {
    return hangs_on_reading(all, static_cast<std::size_t>(other));
  });
}

}  // namespace

EventWatch::EventWatch(const model::BuiltModel& built) : built_(built) {
  const auto& all = built.model.signals.all;
  for (const model::EventSpec& spec : built.description.events) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].name == spec.when) events_.push_back({&spec, k + 1, hangs_on_reading(all, k), {}});
    }
  }
}

double EventWatch::crossing(const Event& event, const model::State& before,
                            const model::State& after) const {
  const double first = before.memory.signals[event.signal];
  if (event.is_held) {  // both readings are known, and nothing between them
    const double last = after.memory.signals[event.signal];
    return before.t + (after.t - before.t) * first / (first - last);
  }
  double low = before.t;
  double high = after.t;
  dynamics::SignalValues at;
  for (int k = 0; k < kBisections; ++k) {
    const double t = 0.5 * (low + high);
    const model::State between = results::interpolate(before, after, t);
    dynamics::evaluate_signals(built_.model, dynamics::motions_of(built_.model, between), t,
                               dynamics::circumstances_of(between), at);
    const bool is_past = (at.values[event.signal] > 0.0) != (first > 0.0);
    (is_past ? high : low) = t;
  }
  return high;
}

void EventWatch::count(Event& event, double t) {
  event.recent.push_back(steps_);
  std::erase_if(event.recent, [&](long step) { return step <= steps_ - kWithinSteps; });
  if (event.recent.size() <= kMostEvents) return;
  throw NumericalError(
      event.spec->where,
      fmt::format(
          "event \"{}\" happened {} times within {} steps up to t = {:.6g} s: signal \"{}\" "
          "chatters about zero; give it a `switch` with two levels, a `lag`, or use smaller "
          "steps",
          event.spec->name, event.recent.size(), kWithinSteps, t, event.spec->when));
}

std::vector<EventWatch::Found> EventWatch::after_step(const model::State& before,
                                                      const model::State& after) {
  std::vector<Found> out;
  ++steps_;
  for (Event& event : events_) {
    const double first = before.memory.signals[event.signal];
    const double last = after.memory.signals[event.signal];
    if (!crosses(event.spec->direction, first, last)) continue;
    out.push_back({fmt::format("event \"{}\" at t = {:.9g} s: signal \"{}\" {} through zero",
                               event.spec->name, crossing(event, before, after), event.spec->when,
                               last >= 0.0 && first < 0.0 ? "rises" : "falls"),
                   event.spec->action == model::EventAction::stop, event.spec});
    count(event, after.t);
  }
  return out;
}

bool EventWatch::holds_action(const model::State& before, const model::State& after) const {
  return std::any_of(events_.begin(), events_.end(), [&](const Event& event) {
    return event.spec->acts() && crosses(event.spec->direction, before.memory.signals[event.signal],
                                         after.memory.signals[event.signal]);
  });
}

std::vector<EventWatch::Found> EventWatch::after_actions(const std::vector<double>& before,
                                                         const model::State& state) {
  std::vector<Found> out;
  for (Event& event : events_) {
    const double first = before[event.signal];
    const double last = state.memory.signals[event.signal];
    if (!crosses(event.spec->direction, first, last)) continue;
    out.push_back({fmt::format("event \"{}\" at t = {:.9g} s: signal \"{}\" jumps through zero",
                               event.spec->name, state.t, event.spec->when),
                   event.spec->action == model::EventAction::stop, event.spec});
    count(event, state.t);
  }
  return out;
}

void EventWatch::visit_saved(const base::SaveVisit& visit) {
  visit.count("steps", steps_, 0, std::numeric_limits<long>::max());
  for (std::size_t k = 0; k < events_.size(); ++k) {
    visit.inside(k).counts("recent", events_[k].recent, 0L, std::numeric_limits<long>::max());
  }
}

}  // namespace buckens::analysis
