// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/rest_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/analysis/statics/held_spots.h"
#include "buckens/analysis/statics/rest_stop.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/coordinate_motor.h"
#include "buckens/loads/reaction_follower.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

using Kind = RestRow::Kind;

namespace {

// A gap of this share of the model's length, or of 1 rad, is none.
constexpr double kTouching = 1e-9;

const loads::RigidStop& stop_at(const model::Model& model, const RestRow& row) {
  return *stop_of(model.loads[row.load]);
}

/// An elastic contact with friction, else null.
const loads::Contact* rough_contact(const loads::ForceElement& element) {
  const auto* contact = dynamic_cast<const loads::Contact*>(&element);
  return contact != nullptr && contact->data().static_coefficient > 0.0 ? contact : nullptr;
}

/// The group of a load that is contacts of many bodies with friction, else null.
const model::ContactGroup* rough_group(const model::Model& model, std::size_t load) {
  for (const auto& group : model.contact_groups) {
    if (group->load == load && group->law.static_coefficient > 0.0) return group.get();
  }
  return nullptr;
}

bool rubs(const loads::ForceElement& element) {
  if (rough_contact(element) != nullptr) return true;
  return dynamic_cast<const loads::ContactFriction*>(&element) != nullptr ||
         dynamic_cast<const loads::ReactionFollower*>(&element) != nullptr ||
         dynamic_cast<const loads::CoordinateBrake*>(&element) != nullptr;
}

/// Whether a load is rigid contacts of many bodies, with friction.
bool is_rough_rigid_group(const model::Model& model, std::size_t load) {
  return std::any_of(
      model.contact_groups.begin(), model.contact_groups.end(), [load](const auto& group) {
        return group->load == load && group->rigid && group->rigid->static_coefficient > 0.0;
      });
}

}  // namespace

RestRows::RestRows(const model::Model& model, model::RestFriction friction,
                   const model::State& state, model::RigidPairs* groups)
    : model_(model), friction_(friction), groups_(groups) {
  switched_.off = state.memory.off;
  const std::size_t count =
      model.pair_loads.empty() ? model.loads.size() : model.pair_loads.front().first;
  for (std::size_t k = 0; k < count; ++k) {
    const model::Load& load = model.loads[k];
    if (state.memory.is_off(k)) continue;
    if (stop_of(load) != nullptr) {
      RestRow row{Kind::one_sided, k};
      row.is_angle = model.coordinates[static_cast<std::size_t>(load.coordinate)].law.is_angle();
      rows_.push_back(row);
    } else if (friction == model::RestFriction::frozen) {
      add_friction(state, k);
    } else if (rubs(*load.element) || rough_group(model, k) != nullptr ||
               is_rough_rigid_group(model, k)) {
      leaves_friction_ = true;
    }
  }
  num_lasting_ = rows_.size();
  auto motions = dynamics::motions_of(model, state);
  RestValues values;
  evaluate(motions, state.t, values);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind == Kind::held) rows_[k].start = values.values[k];
  }
  for (dynamics::BodyMotion& motion : motions) {
    motion.frame.w.setZero();
    motion.frame.v.setZero();
    motion.y_dot.setZero();
  }
  follow_pairs(motions, false);
}

std::string RestRows::name(std::size_t k) const {
  const std::size_t load = rows_[k].load;
  const std::string& name = model_.loads[load].name;
  if (model_.pair_loads.empty() || load < model_.pair_loads.front().first) return name;
  const auto bodies = {model_.loads[load].first.body, model_.loads[load].second.body};
  std::vector<std::string> names;
  for (const int b : bodies) {
    const bool is_ground = b == model::kGround;
    names.push_back(is_ground ? "ground" : model_.bodies[static_cast<std::size_t>(b)].name);
  }
  return fmt::format("{}\" between \"{}\" and \"{}", name, names[0], names[1]);
}

void RestRows::add_friction(const model::State& state, std::size_t k) {
  const model::Load& load = model_.loads[k];
  const loads::ForceElement* element = load.element.get();
  RestRow row{Kind::held, k};
  if (load.coordinate >= 0) {
    row.is_angle = model_.coordinates[static_cast<std::size_t>(load.coordinate)].law.is_angle();
  }
  if (rough_group(model_, k) != nullptr) {
    add_pairs(k);
  } else if (dynamic_cast<const loads::ContactFriction*>(element) != nullptr) {
    row.kind = Kind::along;
    row.across = static_cast<int>(rows_.size()) - 1;
    while (rows_[static_cast<std::size_t>(row.across)].kind != Kind::one_sided) --row.across;
    rows_.push_back(row);
  } else if (rough_contact(*element) != nullptr) {
    row.kind = Kind::along;
    for (row.part = 0; row.part < element->num_soft_rows(); ++row.part) {
      if (row.part % RestRow::kOfSpot != 0) rows_.push_back(row);
    }
  } else if (dynamic_cast<const loads::ReactionFollower*>(element) != nullptr) {
    const bool is_ball = load.coordinate < 0;
    row.is_angle = row.is_angle || is_ball;
    for (row.part = 0; row.part < (is_ball ? 3 : 1); ++row.part) rows_.push_back(row);
  } else if (const auto* brake = dynamic_cast<const loads::CoordinateBrake*>(element)) {
    const auto motions = dynamics::motions_of(model_, state);
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, nullptr);
    dynamics::SignalValues signals;
    const dynamics::Circumstances around =
        dynamics::with_signals(model_, motions, state.t, {}, signals);
    const loads::Sight sight = dynamics::sight_of(model_, k, state.t, around, ends);
    if (brake->bound(sight) > 0.0) rows_.push_back(row);
  }
}

void RestRows::evaluate(const std::vector<dynamics::BodyMotion>& motions, double t,
                        RestValues& out) const {
  out.rows.clear();
  out.values.clear();
  out.pushes.clear();
  out.contacts.assign(rows_.size(), {});
  out.presses.assign(rows_.size(), 0);
  out.nears.assign(rows_.size(), 0);
  std::vector<loads::SoftRow> soft;
  dynamics::SignalValues signals;
  const dynamics::Circumstances around =
      rows_.empty() ? dynamics::Circumstances()
                    : dynamics::with_signals(model_, motions, t, {}, signals);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const RestRow& row = rows_[k];
    if (row.pair >= 0) {
      evaluate_pair(k, motions, t, soft, out);
      continue;
    }
    const model::Load& load = model_.loads[row.load];
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, nullptr);
    const loads::Sight sight = dynamics::sight_of(model_, row.load, t, around, ends);
    spatial::PairRow J = sight.coordinate.J;
    if (load.coordinate < 0) {
      find_soft_rows(k, *load.element, sight, soft, out);
      J = soft[static_cast<std::size_t>(row.part)].J;
    }
    dynamics::row_of(model_, load, ends, J, out.rows.emplace_back());
    out.values.push_back(sight.coordinate.value);
    out.pushes.push_back({J.segment<3>(6).transpose(), J.segment<3>(9).transpose()});
    if (row.kind == Kind::one_sided) {
      out.contacts[k] = stop_at(model_, row).contact(sight.coordinate.value);
    }
  }
}

void RestRows::find_soft_rows(std::size_t k, const loads::ForceElement& law,
                              const loads::Sight& sight, std::vector<loads::SoftRow>& soft,
                              RestValues& out) const {
  const RestRow& row = rows_[k];
  const bool is_known = k > 0 && rows_[k - 1].load == row.load && rows_[k - 1].pair == row.pair;
  if (is_known) return;
  soft.clear();
  law.append_tangent(sight, soft);
  if (!row.is_elastic()) return;
  const double reach = kDifference * model_.length;
  HeldSpots spots;
  spots.look(dynamic_cast<const loads::Contact&>(law), sight);
  spots.level(reach, soft);
  for (std::size_t i = k; i < rows_.size() && rows_[i].load == row.load; ++i) {
    if (rows_[i].pair != row.pair) break;
    const auto spot = static_cast<std::size_t>(rows_[i].part / RestRow::kOfSpot);
    out.presses[i] = soft[RestRow::kOfSpot * spot].stiffness > 0.0 ? 1 : 0;
    out.nears[i] = spots.is_near(spot, reach) ? 1 : 0;
  }
}

void RestRows::add_forces(const RestValues& values, const RestStands& stands,
                          dynamics::Forces& out) const {
  dynamics::Constraints rows;
  rows.rows = values.rows;
  linalg::Vector forces(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    forces[static_cast<Eigen::Index>(k)] = stands[k].force;
  }
  dynamics::add_joint_forces(rows, forces, out);
}

double RestRows::gap(std::size_t k, const RestValues& values, int regime) const {
  const RestRow& row = rows_[k];
  if (row.kind == Kind::along) return 0.0;
  if (row.kind == Kind::held) return values.values[k] - row.start;
  return values.values[k] - stop_at(model_, row).end(regime);
}

double RestRows::push(std::size_t k, const loads::RowStand& stand) const {
  if (rows_[k].kind != Kind::one_sided) return 0.0;
  return stand.regime == 2 ? -stand.force : stand.force;
}

bool RestRows::touches(std::size_t k, const RestValues& values) const {
  return rows_[k].kind == Kind::one_sided && values.contacts[k].gap <= kTouching * length_of(k);
}
}  // namespace buckens::analysis
