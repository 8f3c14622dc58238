// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/row_memory.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/signals.h"

namespace buckens::dynamics {

namespace {

double fraction_of(const model::Model& model, const model::Coordinate& coordinate,
                   const std::vector<BodyMotion>& motions) {
  return coordinate.law.fraction(evaluate_marker(model, coordinate.first, motions).motion,
                                 evaluate_marker(model, coordinate.second, motions).motion);
}

/// @param lambda may be null: joints carry nothing
void follow_rows(const model::Model& model, const std::vector<BodyMotion>& motions,
                 const linalg::Vector* lambda, const double* before, linalg::Vector& after) {
  for (const model::Joint& joint : model.joints) {
    int state = joint.first_state;
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      const joints::RowLaw* const law = joint.rows[k].law();
      if (law == nullptr) continue;
      const int row = joint.first_row + static_cast<int>(k);
      try {
        law->follow(evaluate_marker(model, joint.first, motions).motion,
                    evaluate_marker(model, joint.second, motions).motion,
                    lambda != nullptr && lambda->size() > 0 ? (*lambda)[row] : 0.0,
                    before == nullptr ? nullptr : before + state, after.data() + state);
      } catch (const NumericalError& error) {
        throw NumericalError(joint.where,
                             fmt::format("joint \"{}\": {}", joint.name, error.text()));
      }
      state += law->num_states();
    }
  }
}

}  // namespace

bool follow_reactions(const model::Model& model, const std::vector<BodyMotion>& motions,
                      const linalg::Vector& lambda, model::RowMemory& memory) {
  if (memory.rows.size() == 0) return false;
  const linalg::Vector before = memory.rows;
  follow_rows(model, motions, &lambda, before.data(), memory.rows);
  return memory.rows != before;
}

model::RowMemory memory_at_rest(const model::Model& model, const std::vector<BodyMotion>& motions,
                                const linalg::Vector& lambda) {
  model::RowMemory out;
  out.rows = linalg::Vector::Zero(model.num_row_states());
  follow_reactions(model, motions, lambda, out);
  return out;
}

model::RowMemory start_memory(const model::Model& model, const std::vector<BodyMotion>& motions) {
  model::RowMemory out;
  for (const model::Coordinate& coordinate : model.coordinates) {
    out.coordinates.push_back({0, fraction_of(model, coordinate, motions)});
  }
  out.laws = linalg::Vector::Zero(model.num_law_states());
  out.rows = linalg::Vector::Zero(model.num_row_states());
  if (out.rows.size() > 0) follow_rows(model, motions, nullptr, nullptr, out.rows);
  for (std::size_t k = 0; k < model.loads.size() && out.laws.size() > 0; ++k) {
    const model::Load& load = model.loads[k];
    if (load.element->num_states() == 0) continue;
    const auto first = evaluate_marker(model, load.first, motions);
    const auto second = evaluate_marker(model, load.second, motions);
    load.element->start_states(
        sight_of(model, k, 0.0, {nullptr, &out, nullptr, nullptr}, first.motion, second.motion),
        out.laws.data() + load.first_state);
  }
  start_signals(model, motions, 0.0, out);
  return out;
}

void advance_memory(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                    const Circumstances& around, model::RowMemory& out) {
  const model::RowMemory& before = *around.memory;
  out.coordinates.resize(before.coordinates.size());
  for (std::size_t k = 0; k < before.coordinates.size(); ++k) {
    const model::Coordinate& coordinate = model.coordinates[k];
    out.coordinates[k] =
        coordinate.law.follow(before.coordinates[k], fraction_of(model, coordinate, motions));
  }
  out.rows.resize(before.rows.size());
  if (before.rows.size() > 0) {
    follow_rows(model, motions, around.lambda, before.rows.data(), out.rows);
  }
  out.laws.resize(before.laws.size());
  for (std::size_t k = 0; k < model.loads.size() && before.laws.size() > 0; ++k) {
    const model::Load& load = model.loads[k];
    if (load.element->num_states() == 0) continue;
    const auto first = evaluate_marker(model, load.first, motions);
    const auto second = evaluate_marker(model, load.second, motions);
    load.element->find_states(sight_of(model, k, t, around, first.motion, second.motion),
                              out.laws.data() + load.first_state);
  }
  advance_signals(model, motions, t, around, out);
}

}  // namespace buckens::dynamics
