// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/rough_contacts.h"

#include <algorithm>

#include "buckens/analysis/initial/frame_acceleration.h"
#include "buckens/analysis/initial/quasi_static_start.h"

namespace buckens::analysis {

namespace {

// Where forces settle, they have done so with fewer decisions that change no stand. Between wedged
// bodies they may go on for ever, and each takes up to a fifth of a second.
constexpr int kMostInVain = 40;

}  // namespace

RoughContacts::RoughContacts(const model::Model& model, const dynamics::MassMetric& metric,
                             const std::vector<int>& rows_in_use)
    : model_(model), metric_(metric), rows_in_use_(rows_in_use), cones_(model), rigid_(model) {
  for (const body::Body& body : model.bodies) {
    compliance_.push_back({dynamics::frame_mobility(body, body.J0), nullptr});
  }
}

bool RoughContacts::decide(const dynamics::Forces& forces, model::State& state) {
  rigid_.start(state.memory);
  if (in_vain_ >= kMostInVain || cones_.hold(forces.rigid, rigid_)) return false;
  ++in_vain_;
  const auto motions = dynamics::motions_of(model_, state);
  const dynamics::Circumstances around = dynamics::circumstances_of(state);
  dynamics::evaluate_soft_rows(model_, motions, state.t, around, soft_);
  const stepping::RigidInstant now{forces.rigid, soft_,  compliance_, motions,
                                   rows_in_use_, around, state.t};
  if (!cones_.decide(now, 1.0, kInstant, rigid_)) return false;
  const linalg::Vector before = state.memory.laws;
  write(state);
  const bool has_moved =
      std::any_of(model_.loads.begin(), model_.loads.end(), [&](const model::Load& load) {
        return load.rigid_row >= 0 && owns(load.rigid_row) &&
               state.memory.laws[load.first_state] != before[load.first_state];
      });
  if (has_moved) in_vain_ = 0;
  return has_moved;
}

void RoughContacts::write(model::State& state) const {
  for (const model::Load& load : model_.loads) {
    if (load.rigid_row < 0 || !owns(load.rigid_row)) continue;
    const loads::RowStand& stand = rigid_.stands()[static_cast<std::size_t>(load.rigid_row)];
    // A direction that is held is one within a step.
    state.memory.laws[load.first_state] =
        std::min(stand.regime, loads::ContactFriction::kHeldDirection - 1);
    state.memory.laws[load.first_state + 1] = stand.force;
  }
}

void RoughContacts::hold_over(double span, model::State& state) {
  rigid_.start(state.memory);
  const auto motions = dynamics::motions_of(model_, state);
  dynamics::evaluate_soft_rows(model_, motions, state.t, dynamics::circumstances_of(state), soft_);
  dynamics::Forces forces;
  dynamics::evaluate_forces(model_, motions, state.t, dynamics::circumstances_of(state), forces);
  rigid_.let_go(forces.rigid);
  // Without their forces first.
  for (const model::Load& load : model_.loads) {
    if (load.rigid_row < 0 || !owns(load.rigid_row)) continue;
    state.memory.laws[load.first_state] = state.memory.laws[load.first_state + 1] = 0.0;
  }
  settle_accelerations(model_, metric_, rows_in_use_, state);
  dynamics::evaluate_forces(model_, motions, state.t, dynamics::circumstances_of(state), forces);
  foresee(motions, state, span, forces.rigid);
  for (std::size_t k = 0; k < forces.rigid.size(); ++k) {
    if (owns(static_cast<int>(k))) rigid_.put(static_cast<int>(k), {rigid_.stands()[k].regime, 0});
  }
  const dynamics::Circumstances around = dynamics::circumstances_of(state);
  cones_.hold_over({forces.rigid, soft_, compliance_, motions, rows_in_use_, around, state.t}, span,
                   rigid_);
  write(state);
  settle_accelerations(model_, metric_, rows_in_use_, state, cones_.rows());
}

bool RoughContacts::are_sudden(const model::State& state, double span) const {
  constexpr double kByWeight = 5.0;
  dynamics::Forces forces;
  dynamics::evaluate_forces(model_, dynamics::motions_of(model_, state), state.t,
                            dynamics::circumstances_of(state), forces);
  double speed = 0.0, change = 0.0;
  for (const model::Load& load : model_.loads) {
    if (load.rigid_row < 0 || !owns(load.rigid_row)) continue;
    if (state.memory.laws[load.first_state] == 0.0) continue;
    speed = std::max(speed, std::abs(forces.rigid[static_cast<std::size_t>(load.rigid_row)].slip));
  }
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const model::BodyState& body = state.bodies[b];
    const double turning = model_.bodies[b].length_scale() * body.w_dot.norm();
    change = std::max({change, body.v_dot.norm(), turning});
  }
  return (change - kByWeight * model_.gravity.norm()) * span > speed;
}

void RoughContacts::foresee(const std::vector<dynamics::BodyMotion>& motions,
                            const model::State& state, double span,
                            std::vector<loads::RigidRow>& rows) const {
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const int rigid_row = soft_.rigid[k];
    if (rigid_row < 0 || !owns(rigid_row)) continue;
    const model::Load& load = model_.load_of_rigid_row(rigid_row);
    double rate = 0.0;
    for (const dynamics::BodyRow* part : soft_.rows[k].parts()) {
      if (part->body != model::kGround) {
        rate += part->rate(motions[static_cast<std::size_t>(part->body)]);
      }
    }
    const double acceleration = frame_acceleration(model_, load, soft_.rows[k], motions, state);
    loads::RigidRow& row = rows[static_cast<std::size_t>(rigid_row)];
    row.slip = rate + span * acceleration;
    row.is_closed = false;
    row.given = 0.0;
  }
}

}  // namespace buckens::analysis
