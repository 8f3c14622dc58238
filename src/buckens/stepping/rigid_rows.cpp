// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/rigid_rows.h"

#include <algorithm>

#include "buckens/loads/rigid_law.h"
#include "buckens/stepping/mesh_partners.h"

namespace buckens::stepping {

namespace {
// Rigid rows with less independence than this fraction hold what others hold.
constexpr double kTheSame = 1e-11;
// Share of damping in what resists within a step, compared with stiffness, above which it reverses
// rates. Of bars on the floor, those with 0.29 and more gain by this; an undamped one, whose rates
// stiffness alone reverses, left twice as much energy open.
constexpr double kTurns = 0.25;

// What a row that a mesh takes part in holds: an end, which only pushes, or a direction of friction
// there. Open, neither does anything.
enum : char { kNothing, kEnd, kAlong };

// Along which directions friction slides: of a surface, or of all rotations of a ball. Others slide
// forwards or backwards, if at all.
enum : char { kToAndFro, kInSurface, kAllAround };

char sliding_of(const loads::RigidLaw& law) {
  return law.row_of_ball() >= 0 ? kAllAround : law.row_of_place() > 0 ? kInSurface : kToAndFro;
}

char held_by(const model::Load& load) {
  const auto& law = static_cast<const loads::RigidLaw&>(*load.element);
  return law.contact(0.0).regime != 0 ? kEnd : law.row_of_place() > 0 ? kAlong : kNothing;
}

/// Whether a row does the other way at the end of a step than over the whole of it, where
/// vibrations of a mesh turn within the step. @param released see RigidRows::open()
bool turns_at_end(double force, double released) { return force * (force - released) < 0.0; }

/// Whether the finest parts of a body have rates that its damping turns round from step to step.
bool rates_turn(const body::Body& body, const Scheme& scheme) {
  if (!body.is_flexible() || body.flexible->is_quasi_static || !body.flexible->is_damped()) {
    return false;
  }
  // Traces are above all those of the finest parts.
  const double damping = scheme.damping * body.flexible->C.diagonal().sum();
  const double stiffness = scheme.stiffness * body.flexible->fe.K.diagonal().sum();
  return damping > kTurns * (damping + stiffness);
}

}  // namespace

RigidRows::RigidRows(const model::Model& model, const Scheme* scheme) {
  const std::vector<char> with_mesh = mesh_partners(model);
  const auto is_mesh = [&](int body) {
    return body != model::kGround && with_mesh[static_cast<std::size_t>(body)] != 0;
  };
  const auto turns = [&](int body) {
    return scheme != nullptr && body != model::kGround &&
           rates_turn(model.bodies[static_cast<std::size_t>(body)], *scheme);
  };
  for (const model::Load& load : model.loads) {
    if (load.rigid_row < 0) continue;
    first_states_.push_back(load.first_state);
    loads_.push_back(static_cast<std::size_t>(&load - model.loads.data()));
    const bool moves_mesh = is_mesh(load.first.body) || is_mesh(load.second.body);
    is_on_mesh_.push_back(moves_mesh ? held_by(load) : kNothing);
    slides_.push_back(sliding_of(static_cast<const loads::RigidLaw&>(*load.element)));
    const bool is_end = is_on_mesh_.back() == kEnd;
    turns_by_damping_.push_back(is_end && (turns(load.first.body) || turns(load.second.body)));
  }
  stands_.resize(first_states_.size());
  released_.resize(first_states_.size());
  regimes_at_start_.resize(first_states_.size());
}

void RigidRows::start(const model::RowMemory& memory, double undone) {
  for (std::size_t k = 0; k < stands_.size(); ++k) {
    stands_[k] = {static_cast<int>(memory.laws[first_states_[k]]),
                  memory.laws[first_states_[k] + 1]};
    // A load that an event has switched off holds nothing.
    if (memory.is_off(loads_[k])) stands_[k] = {};
    const bool takes_back = is_on_mesh_[k] != kNothing && stands_[k].regime != 0;
    released_[k] = takes_back ? -undone * stands_[k].force : 0.0;
    regimes_at_start_[k] = stands_[k].regime;
  }
  num_moves_ = 0;
}

bool RigidRows::move(const std::vector<loads::RigidRow>& rows,
                     const std::vector<char>& decided_elsewhere) {
  bool has_moved = false;
  for (std::size_t k = 0; k < stands_.size(); ++k) {
    if (!decided_elsewhere.empty() && decided_elsewhere[k] != 0) continue;
    loads::RowStand next = rows[k].next;
    // A row on a mesh lets go if it has pulled over the step, not if it pulls only at its end.
    const bool is_held = stands_[k].regime != 0 && stands_[k].regime == regimes_at_start_[k];
    if (is_held && is_on_mesh_[k] == kEnd && turns_at_end(stands_[k].force, released_[k])) {
      next = next.regime == 0 ? stands_[k] : open(k);
    }
    const bool is_other = next.regime != stands_[k].regime;
    has_moved = has_moved || is_other;
    if (is_other) stands_[k] = next.regime == 0 ? open(k) : next;
  }
  if (has_moved) ++num_moves_;
  return has_moved;
}

bool RigidRows::let_go(const std::vector<loads::RigidRow>& rows) {
  bool has_changed = false;
  for (std::size_t k = 0; k < stands_.size(); ++k) {
    if (!rows[k].has_gone) continue;
    has_changed = has_changed || stands_[k].regime != 0;
    let_go(static_cast<int>(k));
  }
  return has_changed;
}

void RigidRows::let_go(int row) {
  stands_[static_cast<std::size_t>(row)] = {};
  // Its force acted along the row of another contact point.
  released_[static_cast<std::size_t>(row)] = 0.0;
}

bool RigidRows::put(int row, const loads::RowStand& stand) {
  loads::RowStand& own = stands_[static_cast<std::size_t>(row)];
  const bool is_other = own.regime != stand.regime;
  own = stand.regime == 0 ? open(static_cast<std::size_t>(row)) : stand;
  return is_other;
}

bool RigidRows::only_pulls_at_end(int row) const {
  const auto k = static_cast<std::size_t>(row);
  const bool is_held = stands_[k].regime != 0 && stands_[k].regime == regimes_at_start_[k];
  return is_held && turns_by_damping_[k] != 0 && stands_[k].force < 0.0 &&
         turns_at_end(stands_[k].force, released_[k]);
}

bool RigidRows::ends_have_turned() const {
  for (std::size_t k = 0; k < stands_.size(); ++k) {
    if (is_on_mesh_[k] != kEnd || regimes_at_start_[k] == 0) continue;
    if (stands_[k].regime == 0 || turns_at_end(stands_[k].force, released_[k])) return true;
  }
  return false;
}

bool RigidRows::have_changed() const {
  for (std::size_t k = 0; k < stands_.size(); ++k) {
    // What pulls at the end lets go there.
    const bool is_end = stands_[k].regime != 0 && is_on_mesh_[k] == kEnd;
    if (is_end && turns_at_end(stands_[k].force, released_[k])) return true;
    constexpr int kHeld = loads::RigidLaw::kHeldDirection;
    if (slides_[k] == kAllAround && stands_[k].regime >= kHeld) return true;
    // A direction in a surface that the step has held counts as the same regime.
    const int regime =
        slides_[k] == kInSurface ? std::min(stands_[k].regime, kHeld - 1) : stands_[k].regime;
    if (regime != regimes_at_start_[k]) return true;
  }
  return false;
}

bool factorise_closed_rows(dynamics::MultiplierCondensation& condensation,
                           const std::vector<dynamics::SystemRow>& rows,
                           const std::vector<dynamics::BodyCompliance>& compliance,
                           const std::vector<double>& give) {
  const bool are_independent = condensation.factorise(rows, rows, compliance, {}) &&
                               (give.empty() || condensation.pivot_ratio() > kTheSame);
  return are_independent || condensation.factorise(rows, rows, compliance, give);
}

double own_compliance(const dynamics::SystemRow& row,
                      const std::vector<dynamics::BodyCompliance>& compliance) {
  double sum = 0;
  for (const dynamics::BodyRow* part : row.parts()) {
    if (part->body == model::kGround) continue;
    const dynamics::BodyCompliance& body = compliance[static_cast<std::size_t>(part->body)];
    sum += part->frame * body.frame * part->frame.transpose();
    if (body.interface == nullptr) continue;
    const linalg::Matrix& C = *body.interface;
    for (int i = 0; i < 6; ++i) {
      const int first = i < 3 ? part->translation_row : part->rotation_row;
      if (first >= 0)
        sum += part->interface[i] * part->interface[i] * C(first + i % 3, first + i % 3);
    }
  }
  return sum;
}

}  // namespace buckens::stepping
