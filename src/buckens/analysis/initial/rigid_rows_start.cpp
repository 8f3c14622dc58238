// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/rigid_rows_start.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include <fmt/format.h>

#include "buckens/analysis/initial/acceleration.h"
#include "buckens/analysis/initial/balls_start.h"
#include "buckens/analysis/initial/quasi_static_start.h"
#include "buckens/analysis/initial/rough_contacts.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/forces.h"
#include "buckens/loads/contact_friction.h"

namespace buckens::analysis {

namespace {

constexpr int kMostRowRounds = 450;
// Changes of accelerations by this share of the largest one, and those that may be rounding where
// they do not fall any more.
constexpr double kSameMotion = 1e-13;
constexpr double kRoundingOfMotion = 1e-9;

/// The end of the list if there is none.
auto find_rough_contact(const model::Model& model) {
  return std::find_if(model.loads.begin(), model.loads.end(), [](const model::Load& load) {
    return dynamic_cast<const loads::ContactFriction*>(load.element.get()) != nullptr;
  });
}

/// Moves rows to the stands that follow. @return names of the loads that moved
/// @param released per rigid row: what has once let go here is not closed again, since at a rate of
///        nearly zero its sign says nothing
/// @param rough where they are decided together, else null
std::string move_rows(const model::Model& model, RoughContacts* rough, std::vector<char>& released,
                      model::State& state) {
  dynamics::Forces forces;
  dynamics::evaluate_forces(model, dynamics::motions_of(model, state), state.t,
                            dynamics::circumstances_of(state), forces);
  std::string names;
  if (rough != nullptr && rough->decide(forces, state)) {
    names = fmt::format("\"{}\"", find_rough_contact(model)->name);
  }
  for (const model::Load& load : model.loads) {
    if (load.rigid_row < 0 || (rough != nullptr && rough->owns(load.rigid_row))) continue;
    const loads::RowStand& next = forces.rigid[static_cast<std::size_t>(load.rigid_row)].next;
    double* const stand = state.memory.laws.data() + load.first_state;
    if (static_cast<int>(stand[0]) == next.regime) continue;
    char& has_let_go = released[static_cast<std::size_t>(load.rigid_row)];
    if (has_let_go) continue;
    has_let_go = forces.rigid[static_cast<std::size_t>(load.rigid_row)].is_closed;
    stand[0] = next.regime;
    stand[1] = next.force;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", load.name);
  }
  return names;
}

/// Accelerations of all bodies, rotations times the model's length [m/s²].
linalg::Vector accelerations_of(const model::Model& model, const model::State& state) {
  linalg::Vector out(6 * std::ssize(state.bodies));
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const auto place = 6 * static_cast<Eigen::Index>(b);
    out.segment<3>(place) = model.length * state.bodies[b].w_dot;
    out.segment<3>(place + 3) = state.bodies[b].v_dot;
  }
  return out;
}

/// Share of the change of forces in a round that the next one takes over. Where friction takes much
/// of what presses, whole changes go to and fro ever further.
double share_of(int round) {
  constexpr int kWhole = 30, kThird = 150;
  return round < kWhole ? 1.0 : round < kThird ? 0.3 : 0.1;
}

/// Takes back a part of what forces of rigid rows have changed by. @param before all memories of
/// laws
void take_back(const model::Model& model, const linalg::Vector& before, double part,
               linalg::Vector& laws) {
  for (const model::Load& load : model.loads) {
    if (load.rigid_row < 0) continue;
    const int force = load.first_state + 1;
    laws[force] -= part * (laws[force] - before[force]);
  }
}

/// Whether rounds have come to an end: forces that places share are known to less, what they do to
/// the bodies is not.
class SettledMotion {
 public:
  explicit SettledMotion(const model::Model& model) : model_(model) {}

  /// @param share of the change that the round was allowed
  bool look(const model::State& state, double share) {
    const linalg::Vector now = accelerations_of(model_, state);
    const double size = std::max(now.cwiseAbs().maxCoeff(), model_.gravity.norm());
    const double change =
        before_.size() > 0 ? (now - before_).cwiseAbs().maxCoeff() / size : HUGE_VAL;
    const bool is_rounding = change <= kRoundingOfMotion * share && change >= 0.5 * change_before_;
    before_ = now;
    change_before_ = change;
    return !(change > kSameMotion * share) || is_rounding;
  }

 private:
  const model::Model& model_;
  linalg::Vector before_;
  double change_before_ = HUGE_VAL;
};

/// The rigid contact with friction whose forces have changed most. @param before memories of laws
const std::string& restless_contact(const model::Model& model, const linalg::Vector& before,
                                    const linalg::Vector& laws) {
  const model::Load* worst = &*find_rough_contact(model);
  double most = 0.0;
  for (const model::Load& load : model.loads) {
    if (dynamic_cast<const loads::ContactFriction*>(load.element.get()) == nullptr) continue;
    // The row across comes before those along.
    const int across = load.first_state - load.element->num_states();
    for (const int force : {across + 1, load.first_state + 1}) {
      const double change = std::abs(laws[force] - before[force]);
      if (change > most) worst = &load;
      most = std::max(most, change);
    }
  }
  return worst->name;
}

/// Accelerations with the rows as they stand. Rows that contradict each other, like a motor that
/// goes on and the stop that it runs against, have forces that no quasi-static body takes: its
/// shape is then left as it is until one of them has let go.
/// @return whether shapes have followed the forces
bool settle_shapes(const model::Model& model, const dynamics::MassMetric& metric,
                   const std::vector<int>& rows_in_use, model::State& state) {
  if (model.num_rigid_rows() == 0 || !has_quasi_static_bodies(model)) {
    settle_accelerations(model, metric, rows_in_use, state);
    return true;
  }
  const model::State before = state;
  try {
    settle_accelerations(model, metric, rows_in_use, state);
    return true;
  } catch (const NumericalError&) {
    state = before;
    compute_accelerations(model, metric, rows_in_use, state);
    return false;
  }
}

/// What kept the rounds from coming to an end.
struct Unrest {
  std::string moved;    ///< names of the loads that moved in the last round
  std::string contact;  ///< the one whose friction changed most, where none moved
};

/// @param rough where rigid contacts with friction are decided together, else null
/// @return whether all have settled
bool settle_in_rounds(const model::Model& model, const dynamics::MassMetric& metric,
                      const std::vector<int>& rows_in_use, RoughContacts* rough,
                      model::State& state, Unrest& unrest) {
  std::vector<char> released(static_cast<std::size_t>(model.num_rigid_rows()));
  // Friction in contacts is that of the forces of the round before.
  const bool is_rough = find_rough_contact(model) != model.loads.end();
  SettledMotion motion(model);
  for (int round = 0; round < kMostRowRounds; ++round) {
    const linalg::Vector before = state.memory.laws;
    const bool do_shapes_follow = settle_shapes(model, metric, rows_in_use, state);
    if (model.num_rigid_rows() == 0) return true;
    unrest.moved = move_rows(model, rough, released, state);
    const double share = share_of(round);
    if (!unrest.moved.empty()) continue;
    // No row lets go: it says why it fails.
    if (!do_shapes_follow) settle_accelerations(model, metric, rows_in_use, state);
    if (!is_rough || motion.look(state, share)) return true;
    unrest.contact = restless_contact(model, before, state.memory.laws);
    if (share < 1.0) take_back(model, before, 1.0 - share, state.memory.laws);
  }
  return false;
}

/// Whether friction slides from rest somewhere, against an acceleration that is not yet known when
/// the forces that hold it are found to be too large.
bool begins_to_slide(const model::Model& model, const model::State& state) {
  const auto motions = dynamics::motions_of(model, state);
  for (const model::Load& load : model.loads) {
    const auto* law = dynamic_cast<const loads::ContactFriction*>(load.element.get());
    if (law == nullptr || state.memory.laws[load.first_state] != 2.0) continue;
    const auto first = dynamics::evaluate_marker(model, load.first, motions);
    const auto second = dynamics::evaluate_marker(model, load.second, motions);
    const spatial::TouchPlace place = law->touch().look(first.motion, second.motion);
    const Eigen::Vector3d v = place.velocity(first.motion, second.motion);
    const double speed = (v - place.normal.dot(v) * place.normal).norm();
    if (!(speed > law->data().at_rest)) return true;
  }
  return false;
}

/// Forces of rigid contacts with friction at the instant. @return whether they have settled, and a
/// step may go on with them
/// @throws NumericalError where friction jams: none exist
bool settle_rough(const model::Model& model, const dynamics::MassMetric& metric,
                  const std::vector<int>& rows_in_use, RoughContacts& contacts, model::State& state,
                  Unrest& unrest) {
  const model::State start = state;
  if (settle_in_rounds(model, metric, rows_in_use, nullptr, state, unrest)) {
    if (begins_to_slide(model, state)) contacts.hold_over(RoughContacts::kInstant, state);
  } else {
    state = start;
    if (!settle_in_rounds(model, metric, rows_in_use, &contacts, state, unrest)) return false;
  }
  return !contacts.are_sudden(state, state.last_step);
}

/// @throws NumericalError naming a rigid contact with friction where they jam over the step, too
void hold_over_step(const model::Model& model, RoughContacts& contacts, model::State& state) try {
  contacts.hold_over(state.last_step, state);
} catch (const NumericalError& failure) {
  throw NumericalError(fmt::format("load \"{}\" at t = {:.6g} s: {}",
                                   find_rough_contact(model)->name, state.t, failure.what()));
}

/// At the start of a run, before any step: what is at rest has forces over the shortest of times.
/// @return whether they exist, and do not just stop what moves
bool hold_over_instant(RoughContacts& contacts, model::State& state) try {
  contacts.hold_over(RoughContacts::kInstant, state);
  return !contacts.are_sudden(state, RoughContacts::kInstant);
} catch (const NumericalError&) {
  return false;
}

void settle_stands(const model::Model& model, const dynamics::MassMetric& metric,
                   const std::vector<int>& rows_in_use, model::State& state) {
  Unrest unrest;
  if (find_rough_contact(model) == model.loads.end()) {
    if (settle_in_rounds(model, metric, rows_in_use, nullptr, state, unrest)) return;
  } else {
    const model::State start = state;
    RoughContacts contacts(model, metric, rows_in_use);
    std::exception_ptr jam;
    try {
      if (settle_rough(model, metric, rows_in_use, contacts, state, unrest)) return;
    } catch (const NumericalError&) {
      jam = std::current_exception();
    }
    // At the instant there are none, or such as no step could go on with.
    state = start;
    if (start.last_step > 0.0) {
      hold_over_step(model, contacts, state);
      return;
    }
    if (hold_over_instant(contacts, state)) return;
    if (jam) std::rethrow_exception(jam);
  }
  if (unrest.moved.empty()) {
    throw NumericalError(fmt::format(
        "load \"{}\" at t = {:.6g} s: its friction cannot balance the forces that press the bodies "
        "together, and it jams; give the contact a `stiffness`, or reduce `static`",
        unrest.contact, state.t));
  }
  throw NumericalError(
      fmt::format("at t = {:.6g} s no combination of holding and releasing satisfies all of the "
                  "rigid loads {}; give one of them a stiffness, or friction `stick: elastic`",
                  state.t, unrest.moved));
}

}  // namespace

void settle_rigid_rows(const model::Model& model, const dynamics::MassMetric& metric,
                       const std::vector<int>& rows_in_use, model::State& state) {
  let_go_of_torn_motors(model, state);
  settle_stands(model, metric, rows_in_use, state);
  aim_balls(model, metric, rows_in_use, state);
}

}  // namespace buckens::analysis
