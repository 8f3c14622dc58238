// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/event_actions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/analysis/initial/after_impact.h"
#include "buckens/analysis/initial/rigid_rows_start.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/signals.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/model/check/event_parameters.h"

namespace buckens::analysis {

namespace {

constexpr int kFree = 0, kLocked = 1;
// How far joints may be open that are attached: of the model's length, and as the sine of an angle.
constexpr double kOpen = 1e-3;
constexpr double kBent = 0.05;
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// How much the residual of a row depends on which way its multiplier pushes: of gears and racks
/// that stand nearer or farther than they were placed, half the play between their teeth.
double play_of(const joints::RowLaw& law, const spatial::MarkerMotion& F,
               const spatial::MarkerMotion& M, double t, const double* states) {
  std::vector<double> pushed(static_cast<std::size_t>(law.num_states()));
  const auto residual = [&](double multiplier) {
    law.follow(F, M, multiplier, t, states, pushed.data());
    return law.evaluate(F, M, t, pushed.data()).g;
  };
  return 0.5 * std::abs(residual(1.0) - residual(-1.0));
}

/// Without any mark the list is empty, as it is restored: one of zeros would count as another one,
/// and rows be selected anew.
void mark(std::vector<char>& marks, std::size_t count, std::size_t which, bool is_marked) {
  marks.resize(count, 0);
  marks[which] = is_marked ? 1 : 0;
  if (std::count(marks.begin(), marks.end(), 1) == 0) marks.clear();
}

}  // namespace

EventActions::Effect EventActions::apply(const model::EventSpec& event,
                                         const std::function<const stepping::Stepper&()>& stepper,
                                         model::State& state) const {
  const model::Model& model = built_.model;
  Effect out;
  const dynamics::Energy before = dynamics::energy(model, state);
  set_signals(event, state);
  switch_loads(event.switch_on, true, state);
  switch_loads(event.switch_off, false, state);
  const dynamics::Energy after = dynamics::energy(model, state);
  out.gained = after.springs - before.springs + (after.gravity - before.gravity);
  for (const std::string& joint : event.release) release_joint(joint, state);
  for (const std::string& joint : event.attach) attach_joint(joint, event, state);
  bool has_locked = !event.attach.empty();
  for (const std::string& joint : event.unlock) hold_joint(joint, false, state);
  for (const std::string& joint : event.lock) {
    has_locked = hold_joint(joint, true, state) || has_locked;
  }
  if (!has_locked) return out;
  const std::vector<int> rows = rows_in_use(state);
  const stepping::Stepper& meshes = stepper();
  const dynamics::Energy open = dynamics::energy(model, state);
  close_gaps(model, rows, &meshes, state);
  const dynamics::Energy closed = dynamics::energy(model, state);
  out.gained += closed.total() - open.total();
  close_rates(model, rows, &meshes, state);
  out.lost = closed.kinetic - dynamics::energy(model, state).kinetic;
  return out;
}

void EventActions::settle(model::State& state) const {
  state.lambda.setZero();  // of joints that have let go, too
  settle_rigid_rows(built_.model, metric_, rows_in_use(state), state);
  state.history = 0;
  follow_signals({}, state);  // rates have jumped
}

void EventActions::follow_signals(const std::vector<dynamics::StateChange>& changes,
                                  model::State& state) const {
  if (built_.model.signals.empty()) return;
  dynamics::change_states(built_.model, dynamics::motions_of(built_.model, state),
                          dynamics::circumstances_of(state), changes, state.memory);
}

/// All values are those before any is changed: their order does not matter.
void EventActions::set_signals(const model::EventSpec& event, model::State& state) const {
  if (event.changes.empty()) return;
  std::vector<dynamics::StateChange> changes;
  const auto set = [&](const std::string& name, const base::SignalLaw& law) {
    for (const model::Signal& signal : built_.model.signals.all) {
      if (signal.name != name) continue;
      changes.push_back({signal.first_state, law.value(state.t, state.memory.signals)});
    }
  };
  for (const model::SettingChange& change : event.changes) {
    if (change.value) set(change.name, *change.value);
    if (!change.vector) continue;
    for (std::size_t k = 0; k < 3; ++k) set(model::kGravitySettings[k], (*change.vector)[k]);
  }
  follow_signals(changes, state);
  strain_contacts(state);
}

/// Where friction of an elastic contact gives less, strains that it holds are less from now on, not
/// from the next step on: that would lose them twice.
void EventActions::strain_contacts(model::State& state) const {
  const model::Model& model = built_.model;
  const auto motions = dynamics::motions_of(model, state);
  dynamics::restrain_near(model, motions, state.t, state.memory);
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const auto* contact = dynamic_cast<const loads::Contact*>(load.element.get());
    if (contact == nullptr || !contact->is_changed() || state.memory.is_off(k)) continue;
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, &state.memory);
    linalg::Vector states(contact->num_states());
    contact->find_states(
        dynamics::sight_of(model, k, state.t, dynamics::circumstances_of(state), ends),
        states.data());
    state.memory.laws.segment(load.first_state, states.size()) = states;
  }
}

void EventActions::switch_loads(const std::vector<std::string>& names, bool on,
                                model::State& state) const {
  const model::Model& model = built_.model;
  const auto motions = dynamics::motions_of(model, state);
  for (const std::string& name : names) {
    for (std::size_t k = 0; k < model.loads.size(); ++k) {
      const model::Load& load = model.loads[k];
      if (load.name != name || state.memory.is_off(k) != on) continue;
      mark(state.memory.off, model.loads.size(), k, !on);
      const int count = load.element->num_states();
      if (count == 0) continue;
      auto states = state.memory.laws.segment(load.first_state, count);
      states.setZero();
      if (!on) continue;
      const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, &state.memory);
      load.element->restart_states(
          dynamics::sight_of(model, k, state.t, dynamics::circumstances_of(state), ends),
          states.data());
    }
  }
}

/// @return whether anything is held that was not
bool EventActions::hold_joint(const std::string& name, bool is_held, model::State& state) const {
  const model::Model& model = built_.model;
  const auto motions = dynamics::motions_of(model, state);
  bool is_new = false;
  for (const model::Load& load : model.loads) {
    if (load.kind != loads::CoordinateLock::kKind) continue;
    const auto index = static_cast<std::size_t>(load.coordinate);
    const auto joint = static_cast<std::size_t>(model.coordinates[index].joint);
    if (model.joints[joint].name != name) continue;
    double* const states = state.memory.laws.data() + load.first_state;
    const bool was_held = states[0] != kFree;
    states[0] = is_held ? kLocked : kFree;
    if (!is_held || !was_held) states[1] = 0.0;
    if (!is_held || was_held) continue;
    states[2] = dynamics::coordinate_motion(model, index, state.t, &state.memory, motions).value;
    is_new = true;
  }
  return is_new;
}

void EventActions::release_joint(const std::string& name, model::State& state) const {
  const auto& joints = built_.model.joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name == name && !joints[j].is_tie) {
      mark(state.memory.released, joints.size(), j, true);
    }
  }
}

void EventActions::attach_joint(const std::string& name, const model::EventSpec& event,
                                model::State& state) const {
  const model::Model& model = built_.model;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const model::Joint& joint = model.joints[j];
    if (joint.name != name || joint.is_tie || !state.memory.is_released(j)) continue;
    mark(state.memory.released, model.joints.size(), j, false);
    look_anew(joint, event, state);
    require_closed(joint, event, state);
  }
}

void EventActions::look_anew(const model::Joint& joint, const model::EventSpec& event,
                             model::State& state) const {
  const model::Model& model = built_.model;
  const auto motions = dynamics::motions_of(model, state);
  if (joint.track) {
    double* const states = state.memory.rows.data() + joint.first_state;
    const double length = joint.track->shape.length();
    const double* const nothing_known = nullptr;
    const double s = dynamics::Travel(model, joint, motions, nothing_known).point().s;
    if (s < 0.0 || s > length) {
      throw NumericalError(
          event.where,
          fmt::format("event \"{}\" at t = {:.6g} s: slider \"{}\" cannot be attached, it is "
                      "{:.3g} m beyond the {} of its beam of {:.6g} m; let the event wait until it "
                      "is beside the beam, or lengthen the beam",
                      event.name, state.t, joint.name, s < 0.0 ? -s : s - length,
                      s < 0.0 ? "start" : "end", length));
    }
    states[0] = 1.0;
    states[1] = s;
    return;
  }
  int place = joint.first_state;
  for (const joints::ConstraintRow& row : joint.rows) {
    if (row.law() != nullptr) {
      const auto F = dynamics::evaluate_marker(model, joint.first, motions).motion;
      const auto M = dynamics::evaluate_marker(model, joint.second, motions).motion;
      double* const states = state.memory.rows.data() + place;
      row.law()->attach(F, M, state.t, states);
      require_meshing(joint, play_of(*row.law(), F, M, state.t, states), event, state.t);
    }
    place += row.num_states();
  }
}

void EventActions::require_meshing(const model::Joint& joint, double play,
                                   const model::EventSpec& event, double t) const {
  const double most = event.tolerance.value_or(kOpen * built_.model.length);
  if (play <= most) return;
  throw NumericalError(
      event.where,
      fmt::format("event \"{}\" at t = {:.6g} s: joint \"{}\" cannot be attached, its teeth stand "
                  "{:.3g} m nearer or farther than as placed, along the line of action (at most "
                  "{:.3g} m); place the bodies as they mesh and move them apart by `initial`, let "
                  "the event wait until they have met, or raise its `tolerance`",
                  event.name, t, joint.name, play, most));
}

void EventActions::require_closed(const model::Joint& joint, const model::EventSpec& event,
                                  const model::State& state) const {
  const double most = event.tolerance.value_or(kOpen * built_.model.length);
  dynamics::Constraints now;
  dynamics::evaluate_constraints(built_.model, dynamics::motions_of(built_.model, state), state.t,
                                 &state.memory, now);
  double apart = 0.0, bent = 0.0;
  for (std::size_t k = 0; k < joint.rows.size(); ++k) {
    const double open = std::abs(now.g[joint.first_row + static_cast<int>(k)]);
    double& worst = joint.rows[k].is_length() ? apart : bent;
    worst = std::max(worst, open);
  }
  if (apart <= most && bent <= kBent) return;
  throw NumericalError(
      event.where,
      fmt::format(
          "event \"{}\" at t = {:.6g} s: joint \"{}\" cannot be attached, its markers are "
          "{:.3g} m apart and turned by {:.3g} degrees against each other (at most {:.3g} m "
          "and {:.3g} degrees); let the event wait until they have met, raise its "
          "`tolerance`, or use a `fixed` joint that holds them `as-found`",
          event.name, state.t, joint.name, apart, std::asin(std::min(bent, 1.0)) * kDegrees, most,
          std::asin(kBent) * kDegrees));
}

std::vector<int> EventActions::rows_in_use(const model::State& state) const {
  dynamics::Constraints all;
  dynamics::evaluate_constraints(built_.model, dynamics::motions_of(built_.model, state), state.t,
                                 &state.memory, all);
  if (all.rows.empty()) return {};
  std::vector<int> rows = metric_.split(all.rows).independent;
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace buckens::analysis
