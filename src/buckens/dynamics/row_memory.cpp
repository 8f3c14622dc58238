// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/row_memory.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/citing.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/signals.h"
#include "buckens/dynamics/travel.h"

namespace buckens::dynamics {

namespace {

// How far beyond an end of a beam counts as rounding, of its length.
constexpr double kBeyondEnd = 1e-9;

/// Motions of the markers of a coordinate, unless it travels along a beam.
struct Markers {
  bool are_known = false;
  spatial::MarkerMotion first, second;
};

/// Of all coordinates: laws look at the markers of theirs. Kept, so that steps allocate nothing.
std::vector<Markers>& markers_of_coordinates() {
  thread_local std::vector<Markers> room;
  return room;
}

/// @param expected where it is to be, null: not known
joints::CoordinateLook look_at(const model::Model& model, const model::Coordinate& coordinate,
                               const std::vector<BodyMotion>& motions,
                               const model::RowMemory* memory, const joints::CountedValue* expected,
                               Markers& markers) {
  const model::Joint* const slider = slider_of(model, coordinate);
  markers.are_known = slider == nullptr;
  if (slider != nullptr) {
    joints::CoordinateLook out;
    out.fraction = Travel(model, *slider, motions, memory).displacement();
    return out;
  }
  markers.first = evaluate_marker(model, coordinate.first, motions).motion;
  markers.second = evaluate_marker(model, coordinate.second, motions).motion;
  return coordinate.law.look(markers.first, markers.second, expected);
}

/// Says that a coordinate cannot be followed through a step.
void require_followed(const model::Model& model, const model::Coordinate& coordinate,
                      const joints::CountedValue& before, const joints::CountedValue& after) {
  const double turn = coordinate.law.turn();
  if (turn == 0.0 || spatial::is_countable(before, after, turn)) return;
  const std::string& name = model.joints[static_cast<std::size_t>(coordinate.joint)].name;
  spatial::require_countable(before, after, turn, fmt::format("joint \"{}\"", name));
}

/// Where a slider is on its beam.
void follow_slider(const model::Model& model, const model::Joint& joint,
                   const std::vector<BodyMotion>& motions, const double* before, double* after) {
  const double s = Travel(model, joint, motions, before).point().s;
  const double length = joint.track->shape.length();
  if (s < -kBeyondEnd * length || s > (1.0 + kBeyondEnd) * length) {
    throw NumericalError(
        fmt::format("the slider has left its beam of {:.6g} m beyond the {} ({}); hold it back by "
                    "a `slide-stop`, end the simulation earlier, or lengthen the beam",
                    length, s < 0.0 ? "start" : "end",
                    s < 0.0 ? joint.track->nodes.front().text : joint.track->nodes.back().text));
  }
  after[0] = 1.0;
  after[1] = s;
}

/// What rows of a joint that has let go remember.
void keep_rows(const model::Joint& joint, const double* before, linalg::Vector& after) {
  int count = 0;
  for (const joints::ConstraintRow& row : joint.rows) count += row.num_states();
  std::copy_n(before + joint.first_state, count, after.data() + joint.first_state);
}

/// @param lambda may be null: joints carry nothing
/// @param released as in the memory, may be null
void follow_rows(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                 const linalg::Vector* lambda, const std::vector<char>* released,
                 const double* before, linalg::Vector& after) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const model::Joint& joint = model.joints[j];
    if (released != nullptr && !released->empty() && (*released)[j] != 0) {
      if (before != nullptr) keep_rows(joint, before, after);
      continue;
    }
    if (joint.track) {
      citing(joint, t, [&] {
        follow_slider(model, joint, motions,
                      before == nullptr ? nullptr : before + joint.first_state,
                      after.data() + joint.first_state);
      });
      continue;
    }
    int state = joint.first_state;
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      const joints::RowLaw* const law = joint.rows[k].law();
      if (law == nullptr) {
        state += joint.rows[k].num_states();  // of drives: written with the signals
        continue;
      }
      const int row = joint.first_row + static_cast<int>(k);
      citing(joint, t, [&] {
        law->follow(evaluate_marker(model, joint.first, motions).motion,
                    evaluate_marker(model, joint.second, motions).motion,
                    lambda != nullptr && lambda->size() > 0 ? (*lambda)[row] : 0.0, t,
                    before == nullptr ? nullptr : before + state, after.data() + state);
      });
      state += law->num_states();
    }
  }
}

}  // namespace

bool follow_reactions(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                      const linalg::Vector& lambda, model::RowMemory& memory) {
  if (memory.rows.size() == 0) return false;
  const linalg::Vector before = memory.rows;
  follow_rows(model, motions, t, &lambda, &memory.released, before.data(), memory.rows);
  return memory.rows != before;
}

model::RowMemory memory_at_rest(const model::Model& model, const std::vector<BodyMotion>& motions,
                                double t, const linalg::Vector& lambda) {
  model::RowMemory out;
  out.rows = linalg::Vector::Zero(model.num_row_states());
  follow_reactions(model, motions, t, lambda, out);
  return out;
}

model::RowMemory start_memory(const model::Model& model, const std::vector<BodyMotion>& motions,
                              const std::vector<char>& released) {
  model::RowMemory out;
  out.released = released;
  for (const model::Coordinate& coordinate : model.coordinates) {
    Markers markers;
    const joints::CoordinateLook look =
        look_at(model, coordinate, motions, nullptr, nullptr, markers);
    out.coordinates.push_back({0, look.fraction, look.rate, 0.0});
  }
  out.laws = linalg::Vector::Zero(model.num_law_states());
  out.rows = linalg::Vector::Zero(model.num_row_states());
  if (out.rows.size() > 0)
    follow_rows(model, motions, 0.0, nullptr, &out.released, nullptr, out.rows);
  SignalValues signals;
  const Circumstances around =
      with_signals(model, motions, 0.0, {nullptr, &out, nullptr, nullptr}, signals);
  for (std::size_t k = 0; k < model.loads.size() && out.laws.size() > 0; ++k) {
    const model::Load& load = model.loads[k];
    if (load.element->num_states() == 0) continue;
    const LoadEnds ends = ends_of(model, load, motions, &out);
    load.element->start_states(sight_of(model, k, 0.0, around, ends),
                               out.laws.data() + load.first_state);
  }
  start_near(model, motions, out);
  start_signals(model, motions, 0.0, out);
  return out;
}

void advance_memory(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                    const Circumstances& around, model::RowMemory& out, const LawEnds* known) {
  const model::RowMemory& before = *around.memory;
  out.off = before.off;
  out.released = before.released;
  std::vector<Markers>& seen = markers_of_coordinates();
  seen.resize(before.coordinates.size());
  out.coordinates.resize(before.coordinates.size());
  for (std::size_t k = 0; k < before.coordinates.size(); ++k) {
    seen[k].are_known = false;
    const model::Coordinate& coordinate = model.coordinates[k];
    if (known != nullptr && known->knows_coordinate(k)) {
      out.coordinates[k] = known->coordinates[k].value;
    } else {
      const joints::JointCoordinate& law = coordinate.law;
      const joints::CountedValue expected = law.expect(before.coordinates[k], t);
      const joints::CoordinateLook look =
          look_at(model, coordinate, motions, &before, &expected, seen[k]);
      out.coordinates[k] = law.follow(expected, look.fraction);
      out.coordinates[k].rate = look.rate;
    }
    require_followed(model, coordinate, before.coordinates[k], out.coordinates[k]);
  }
  out.rows.resize(before.rows.size());
  if (before.rows.size() > 0) {
    follow_rows(model, motions, t, around.lambda, &before.released, before.rows.data(), out.rows);
  }
  out.laws.resize(before.laws.size());
  EndsInTurn in_turn(model, motions, &before);
  for (std::size_t k = 0; k < model.loads.size() && before.laws.size() > 0; ++k) {
    const model::Load& load = model.loads[k];
    if (known != nullptr && known->knows_law(k)) {
      out.laws[load.first_state] = known->laws[k].state;
      continue;
    }
    if (load.element->num_states() == 0) continue;
    if (before.is_off(k)) {
      const int count = load.element->num_states();
      out.laws.segment(load.first_state, count) = before.laws.segment(load.first_state, count);
      continue;
    }
    double* const states = out.laws.data() + load.first_state;
    if (is_open_place(model, k, around)) {
      std::fill_n(states, load.element->num_states(), 0.0);
      continue;
    }
    const auto coordinate = static_cast<std::size_t>(load.coordinate);
    if (load.joint >= 0 && load.coordinate >= 0 && seen[coordinate].are_known) {
      const Markers& markers = seen[coordinate];
      load.element->find_states(sight_of(model, k, t, around, markers.first, markers.second),
                                states);
      continue;
    }
    const LoadEnds& ends = in_turn.of(load);
    citing(load, [&] { load.element->find_states(sight_of(model, k, t, around, ends), states); });
  }
  advance_near(model, motions, t, around, out);
  advance_signals(model, motions, t, around, out);
}

}  // namespace buckens::dynamics
