// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/contact_cones.h"

#include <algorithm>

namespace buckens::stepping {

using linalg::Vector;

namespace {

// Angle between friction and slip, and fraction of the cone, that may be rounding.
constexpr double kAligned = 1e-7;
constexpr double kInside = 1e-10;
// Rates of this fraction of the effect of forces on them are rounding.
constexpr double kNoRate = 1e-9;

}  // namespace

ContactCones::ContactCones(const model::Model& model) : answers_(model) {
  int soft = 0, rigid_rows = 0;
  for (const model::Load& load : model.loads) {
    const auto* law = dynamic_cast<const loads::ContactFriction*>(load.element.get());
    if (law != nullptr && law->direction() == 0) {
      places_.push_back(
          {law, load.rigid_row - 1, soft - 1, law->touch().num_directions(), law->data()});
    }
    soft += load.element->num_soft_rows();
    if (load.rigid_row >= 0) ++rigid_rows;
  }
  is_own_.assign(static_cast<std::size_t>(rigid_rows), 0);
  for (const Place& place : places_) {
    for (int k = 0; k <= place.count; ++k) {
      is_own_[static_cast<std::size_t>(place.across + k)] = 1;
    }
  }
}

ContactCones::Now ContactCones::look(const Place& place, const std::vector<loads::RigidRow>& rows,
                                     const std::vector<loads::RowStand>& stands) {
  const auto across = static_cast<std::size_t>(place.across);
  Now out;
  out.is_pressed = stands[across].regime != 0;
  out.load = stands[across].force;
  for (int k = 0; k < place.count; ++k) {
    const std::size_t along = across + 1 + static_cast<std::size_t>(k);
    out.slip[k] = rows[along].slip;
    out.force[k] = rows[along].is_closed ? stands[along].force : rows[along].given;
    out.sticks = rows[along].is_closed;
  }
  return out;
}

bool ContactCones::holds(const Place& place, const Now& now,
                         const std::vector<loads::RigidRow>& rows,
                         const std::vector<loads::RowStand>& stands) {
  const auto across = static_cast<std::size_t>(place.across);
  for (std::size_t k = across; k <= across + static_cast<std::size_t>(place.count); ++k) {
    if (rows[k].next.regime != stands[k].regime) return false;
  }
  if (!now.is_pressed || now.sticks) return true;
  const double speed = now.slip.norm();
  const double at_rest = place.data.at_rest;
  if (!(speed > at_rest)) return true;
  return (now.force * speed + now.slip * now.force.norm()).norm() <=
         (kAligned * speed + 4.0 * at_rest) * now.force.norm();
}

bool ContactCones::hold(const std::vector<loads::RigidRow>& rows, const RigidRows& rigid) const {
  const std::vector<loads::RowStand>& stands = rigid.stands();
  for (const Place& place : places_) {
    if (rigid.only_pulls_at_end(place.across)) {
      if (rubs(place, stands)) return false;
      continue;
    }
    if (!holds(place, look(place, rows, stands), rows, stands)) return false;
  }
  return true;
}

bool ContactCones::rubs(const Place& place, const std::vector<loads::RowStand>& stands) {
  for (int k = 1; k <= place.count; ++k) {
    if (stands[static_cast<std::size_t>(place.across + k)].regime != 0) return true;
  }
  return false;
}

ContactCones::Pressed ContactCones::gather(const std::vector<loads::RigidRow>& rows,
                                           const dynamics::SoftRows& soft,
                                           const RigidRows& rigid) const {
  const std::vector<loads::RowStand>& stands = rigid.stands();
  Pressed out;
  const auto add = [&](int soft_row, double force, double rate) {
    out.pushes.emplace_back().row = soft.rows[static_cast<std::size_t>(soft_row)];
    out.force.push_back(force);
    out.rate.push_back(rate);
  };
  for (const Place& place : places_) {
    const Now now = look(place, rows, stands);
    if (!now.is_pressed || rigid.only_pulls_at_end(place.across)) continue;
    out.places.push_back(&place);
    add(place.soft, now.load, rows[static_cast<std::size_t>(place.across)].slip);
  }
  for (std::size_t k = 0; k < out.places.size(); ++k) {
    const Place& place = *out.places[k];
    const Now now = look(place, rows, stands);
    const loads::ContactFrictionData& data = place.data;
    out.slips.push_back({static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(out.pushes.size()),
                         place.count,
                         now.sticks ? data.static_coefficient : data.coefficient(now.slip.norm())});
    for (int m = 0; m < place.count; ++m) add(place.soft + 1 + m, now.force[m], now.slip[m]);
  }
  return out;
}

bool ContactCones::condense(const RigidInstant& now, const RigidRows& rigid) {
  if (now.around.memory != nullptr) {
    for (Place& place : places_) place.data = place.law->data_at(now.around.memory->signals);
  }
  // Other rigid rows, such as stops and locks, keep their stands, and so do places that pull only
  // at the end.
  std::vector<dynamics::SystemRow> others;
  for (std::size_t k = 0; k < now.soft.rows.size(); ++k) {
    const int row = now.soft.rigid[k];
    if (row < 0 || !now.soft.is_closed[k]) continue;
    if (is_own_[static_cast<std::size_t>(row)] == 0 || rigid.only_pulls_at_end(row)) {
      others.push_back(now.soft.rows[k]);
    }
  }
  return answers_.condense(now.compliance, now.motions, now.rows_in_use, now.around.memory, now.t,
                           others);
}

ContactCones::Outcome ContactCones::solve(const RigidInstant& now, double per_force,
                                          double per_change, const RigidRows& rigid) const {
  Outcome out;
  out.pressed = gather(now.rows, now.soft, rigid);
  if (out.pressed.places.empty()) return out;
  std::vector<Push>& pushes = out.pressed.pushes;
  for (Push& push : pushes) answers_.answer(push);
  const auto n = static_cast<Eigen::Index>(pushes.size());
  std::vector<const Push*> all;
  for (const Push& push : pushes) all.push_back(&push);
  linalg::SparseMatrix D = PushAnswers::along_all(all);
  // Gyroscopic terms make it slightly unsymmetric, which would let sweeps over places that hold the
  // same thing drift.
  const linalg::SparseMatrix turned = D.transpose();
  D = 0.5 * (D + turned);
  // Rates, converted to changes at the end of the step.
  const Vector P = per_force * Eigen::Map<const Vector>(out.pressed.force.data(), n);
  const Vector b = D * P - Eigen::Map<const Vector>(out.pressed.rate.data(), n) / per_change;
  out.impulses = solve_impact(D, b, std::ssize(out.pressed.places), out.pressed.slips);
  out.rates = per_change * (D * out.impulses - b);
  out.none = kNoRate * per_change * (D.cwiseAbs() * out.impulses.cwiseAbs()).maxCoeff();
  return out;
}

bool ContactCones::decide(const RigidInstant& now, double per_force, double per_change,
                          RigidRows& rigid) {
  if (!condense(now, rigid)) return false;
  bool has_moved = false;
  for (const Place& place : places_) {
    const bool is_pressed = rigid.stands()[static_cast<std::size_t>(place.across)].regime != 0;
    if (is_pressed && !rigid.only_pulls_at_end(place.across)) continue;
    for (int k = 1; k <= place.count; ++k) has_moved = rigid.put(place.across + k, {}) || has_moved;
  }
  const Outcome found = solve(now, per_force, per_change, rigid);
  for (std::size_t k = 0; k < found.pressed.places.size(); ++k) {
    const ImpactSlip& own = found.pressed.slips[k];
    Vector force(1 + own.count);
    force << found.impulses[own.across], found.impulses.segment(own.first, own.count);
    // A place that others hold, too, needs no force of its own; it stays closed.
    if (!(force[0] > 0.0) && found.rates[own.across] <= found.none) continue;
    const double speed = found.rates.segment(own.first, own.count).norm();
    has_moved = put(*found.pressed.places[k], force / per_force, speed, rigid) || has_moved;
  }
  return has_moved;
}

void ContactCones::follow(int across, RigidRows& rigid) const {
  for (const Place& place : places_) {
    if (place.across != across) continue;
    for (int k = 1; k <= place.count; ++k) rigid.put(across + k, {});
  }
}

void ContactCones::hold_over(const RigidInstant& now, double span, RigidRows& rigid) {
  if (!condense(now, rigid)) return;
  const Outcome found = solve(now, span, 1.0, rigid);
  for (std::size_t k = 0; k < found.pressed.places.size(); ++k) {
    const Place& place = *found.pressed.places[k];
    const ImpactSlip& own = found.pressed.slips[k];
    const double load = found.impulses[own.across] / span;
    if (!(load > 0.0)) {
      const bool leaves = found.rates[own.across] > found.none;
      const int regime = rigid.stands()[static_cast<std::size_t>(place.across)].regime;
      rigid.put(place.across, {leaves ? 0 : regime, 0.0});
      for (int m = 1; m <= place.count; ++m) rigid.put(place.across + m, {leaves ? 0 : 1, 0.0});
      continue;
    }
    rigid.put(place.across, {rigid.stands()[static_cast<std::size_t>(place.across)].regime, load});
    const Vector along = found.impulses.segment(own.first, own.count) / span;
    const double speed = found.rates.segment(own.first, own.count).norm();
    const int regime =
        sticks(place, load, along, speed) ? 1 : loads::ContactFriction::kHeldDirection;
    for (int m = 0; m < place.count; ++m) rigid.put(place.across + 1 + m, {regime, along[m]});
  }
}

bool ContactCones::sticks(const Place& place, double load, const Vector& along, double speed) {
  const loads::ContactFrictionData& data = place.data;
  return !(along.norm() > 0.0) || speed <= data.at_rest ||
         along.norm() < (1.0 - kInside) * data.dynamic_coefficient * load;
}

bool ContactCones::put(const Place& place, const Vector& force, double speed,
                       RigidRows& rigid) const {
  const Vector along = force.tail(force.size() - 1);
  const int before = rigid.stands()[static_cast<std::size_t>(place.across) + 1].regime;
  if (!(force[0] > 0.0)) {
    bool has_moved = false;
    for (int k = 0; k <= place.count; ++k) has_moved = rigid.put(place.across + k, {}) || has_moved;
    return has_moved;
  }
  const bool is_held = sticks(place, force[0], along, speed);
  if (is_held && before == 1) return false;
  bool has_moved = is_held;
  int regime = 1;
  if (!is_held) {
    // A new direction gets a new regime number.
    Vector old(place.count);
    for (int k = 0; k < place.count; ++k) {
      old[k] = rigid.stands()[static_cast<std::size_t>(place.across + 1 + k)].force;
    }
    const bool is_same = before >= loads::ContactFriction::kHeldDirection &&
                         (old.normalized() - along.normalized()).norm() <= kAligned;
    if (is_same) return false;
    regime = std::max(before + 1, loads::ContactFriction::kHeldDirection);
    has_moved = true;
  }
  for (int k = 0; k < place.count; ++k) rigid.put(place.across + 1 + k, {regime, along[k]});
  return has_moved;
}

}  // namespace buckens::stepping
