// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/coupling_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/initial/acceleration.h"
#include "buckens/dynamics/energy.h"

namespace buckens::analysis {

using body::CouplingTerms;

namespace {

constexpr long kWindow = 10;  // steps between decisions
// Inertia loads deform a body by (w² + |ẇ|)/ω₁² of its size; below this fraction of the tolerance
// their part in even smaller loads is negligible.
constexpr double kNoDeformation = 1e-3;
constexpr double kUnsupportedSpin = 0.03;  // |w|/ω₁

double relative(double change, double size) { return size > 0.0 ? change / size : 0.0; }

}  // namespace

CouplingWatch::CouplingWatch(const model::Model& model, const dynamics::MassMetric& metric,
                             std::vector<int> rows_in_use)
    : model_(model),
      metric_(metric),
      rows_in_use_(std::move(rows_in_use)),
      bodies_(model.bodies.size()) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!model.bodies[b].is_flexible()) continue;
    const body::CouplingChoice& choice = model.bodies[b].flexible->coupling;
    bodies_[b].is_automatic = choice.is_automatic;
    bodies_[b].tolerance = choice.tolerance;
  }
  for (const model::Joint& joint : model.joints) {
    for (const model::MarkerId* side : {&joint.first, &joint.second}) {
      if (side->body != model::kGround)
        bodies_[static_cast<std::size_t>(side->body)].is_supported = true;
    }
  }
}

bool CouplingWatch::is_measured(const Watched& body, const model::BodyState& state) const {
  if (state.d.size() == 0 || state.terms == CouplingTerms{}) return false;
  // If nothing depends on it, now and then is enough.
  return body.is_automatic || steps_ % kWindow == 0;
}

double CouplingWatch::measure(std::size_t b, const stepping::Stepper& stepper,
                              const model::State& state, const CouplingTerms& kept) {
  if (!stepper.has_balance(b, state, kept)) {
    products_ += model_.bodies[b].flexible->is_damped() ? 2 : 1;
  }
  return stepper.neglected(b, state, kept);
}

CouplingTerms CouplingWatch::needed(std::size_t b, const stepping::Stepper& stepper,
                                    const model::State& state) {
  const Watched& watched = bodies_[b];
  const model::BodyState& s = state.bodies[b];
  const double w = s.frame.w.norm();
  const double omega = watched.omega;
  if (!watched.is_supported && w > kUnsupportedSpin * omega) return {};
  if (omega > 0.0) {
    const double spin = w * w / (omega * omega);
    const double spin_up = s.w_dot.norm() / (omega * omega);
    if (std::max(spin, spin_up) > watched.tolerance) return {};
    if (spin + spin_up <= kNoDeformation * watched.tolerance) return s.terms;
  }
  if (watched.window <= watched.tolerance) return s.terms;
  if (s.terms == CouplingTerms::none()) {
    const CouplingTerms first = CouplingTerms::first_order();
    if (measure(b, stepper, state, first) <= 0.5 * watched.tolerance) return first;
  }
  return {};
}

bool CouplingWatch::decide(const stepping::Stepper& stepper, model::State& state) {
  std::vector<std::pair<std::size_t, CouplingTerms>> moves;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!bodies_[b].is_automatic || state.bodies[b].terms == CouplingTerms{}) continue;
    const CouplingTerms terms = needed(b, stepper, state);
    bodies_[b].window = 0;
    if (terms != state.bodies[b].terms) moves.emplace_back(b, terms);
  }
  if (moves.empty()) return false;
  const double E = dynamics::energy(model_, state).total();
  const dynamics::Momentum H = dynamics::momentum(model_, state);
  std::string names;
  for (const auto& [b, terms] : moves) {
    state.bodies[b].terms = terms;
    names += fmt::format("{}\"{}\" to {}", names.empty() ? "" : ", ", model_.bodies[b].name,
                         to_string(terms));
  }
  compute_accelerations(model_, metric_, dynamics::held_rows(model_, state.memory, rows_in_use_),
                        state);
  state.history = 0;
  if (steps_ == 0) return true;  // nothing has happened at another level
  const dynamics::Energy energy = dynamics::energy(model_, state);
  const double size = std::max(std::abs(energy.kinetic) + std::abs(energy.strain), 1e-300);
  const dynamics::Momentum now = dynamics::momentum(model_, state);
  const std::string text = fmt::format(
      "coupling moved up at t = {:.6g} s: {}; energy jumps by {:.3g} J ({:.2g} of kinetic and "
      "strain energy), angular momentum by {:.3g} N m s ({:.2g})",
      state.t, names, energy.total() - E, relative(std::abs(energy.total() - E), size),
      (now.angular - H.angular).norm(),
      relative((now.angular - H.angular).norm(), now.angular.norm()));
  for (const auto& [b, terms] : moves) bodies_[b].changes.push_back(text);
  return true;
}

void CouplingWatch::start(const stepping::Stepper& stepper, model::State& state) {
  // A body may have to move up twice: accelerations at the new level may require more.
  for (int round = 0; round < 2; ++round) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!bodies_[b].is_automatic) continue;
      bodies_[b].window = measure(b, stepper, state, state.bodies[b].terms);
    }
    if (!decide(stepper, state)) break;
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b].first = state.bodies[b].terms;
}

void CouplingWatch::after_step(const stepping::Stepper& stepper, model::State& state) {
  ++steps_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!is_measured(bodies_[b], state.bodies[b])) continue;
    const double share = measure(b, stepper, state, state.bodies[b].terms);
    bodies_[b].window = std::max(bodies_[b].window, share);
    bodies_[b].neglected = std::max(bodies_[b].neglected, share);
  }
  if (steps_ % kWindow == 0) decide(stepper, state);
}

void CouplingWatch::fill(const model::State& state, results::RunSummary& summary) const {
  std::vector<std::string> told;
  const auto add_once = [](std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };
  for (std::size_t k = 0; k < model_.wholes.size(); ++k) {
    const model::WholeBody& whole = model_.wholes[k];
    const auto first = static_cast<std::size_t>(whole.first);
    if (!model_.bodies[first].is_flexible()) continue;
    // The frames of a body may have different levels.
    std::vector<std::string> at_start;
    std::vector<std::string> now;
    double neglected = 0;
    for (std::size_t b = first; b < first + static_cast<std::size_t>(whole.count); ++b) {
      add_once(at_start, to_string(bodies_[b].first));
      add_once(now, to_string(state.bodies[b].terms));
      neglected = std::max(neglected, bodies_[b].neglected);
      for (const std::string& text : bodies_[b].changes) add_once(told, text);
    }
    std::string level = fmt::format("{}", fmt::join(now, " and "));
    if (bodies_[first].is_automatic) {
      const std::string start = fmt::format("{}", fmt::join(at_start, " and "));
      level = start == level ? fmt::format("auto: {}", start)
                             : fmt::format("auto: {}, then {}", start, level);
    }
    summary.bodies[k].coupling = level;
    summary.bodies[k].measures.emplace_back("largest_neglected_share", neglected);
  }
  for (const std::string& text : told) summary.notes.push_back(text);
}

}  // namespace buckens::analysis
