// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/rest_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/coordinate_motor.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

using Kind = RestRow::Kind;

namespace {

// A gap of this share of the model's length, or of 1 rad, is none.
constexpr double kTouching = 1e-9;
// Of rows that share a load: about ten times what closed ones are left with.
constexpr double kSharing = 1e-11;
// Overlap at the start that is worth a warning.
constexpr double kLargeOverlap = 1e-3;

const loads::RigidStop* stop_of(const model::Load& load) {
  return dynamic_cast<const loads::RigidStop*>(load.element.get());
}

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

dynamics::SystemRow rest_row_of(const model::Model& model, const model::Load& load,
                                const dynamics::LoadEnds& ends, const spatial::PairRow& J) {
  if (!ends.travel) {
    return dynamics::system_row(model, load.first, ends.first, load.second, ends.second, J);
  }
  dynamics::SystemRow out;
  ends.travel->derive({0.0, 0.0, J.segment<3>(9).transpose()},
                      model.num_constraint_rows() + load.coordinate, out);
  return out;
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

bool RestRows::is_off(const model::NearPair& pair) const {
  return switched_.is_off(model_.contact_groups[static_cast<std::size_t>(pair.group)]->load);
}

bool RestRows::follow_pairs(const std::vector<dynamics::BodyMotion>& way, bool keeps) {
  if (groups_ == nullptr) return false;
  std::vector<model::NearPair> now = dynamics::find_rigid_pairs_on(model_, way);
  std::erase_if(now, [this](const model::NearPair& pair) { return is_off(pair); });
  if (keeps) {
    for (const PairRows& known : order_) now.push_back(known.pair);
    std::sort(now.begin(), now.end());
    now.erase(std::unique(now.begin(), now.end()), now.end());
  }
  const auto& loads = model_.pair_loads;
  const bool are_same =
      std::equal(now.begin(), now.end(), loads.begin(), loads.end(),
                 [](const model::NearPair& a, const model::PairLoads& b) { return a == b.pair; });
  if (!are_same) groups_->set(now);
  const RestOrder before = order_;
  add_rigid_pairs();
  return order_ != before;
}

void RestRows::add_rigid_pairs() {
  rows_.resize(num_lasting_);
  order_.clear();
  for (const model::PairLoads& pair : model_.pair_loads) {
    const std::size_t before = rows_.size();
    int across = -1;
    for (std::size_t k = pair.first; k < pair.first + pair.count; ++k) {
      if (stop_of(model_.loads[k]) != nullptr) {
        across = static_cast<int>(rows_.size());
        rows_.push_back({Kind::one_sided, k});
      } else if (friction_ == model::RestFriction::frozen) {
        RestRow row{Kind::along, k};
        row.across = across;
        rows_.push_back(row);
      }
    }
    order_.push_back({pair.pair, rows_.size() - before});
  }
}

std::vector<int> RestRows::places_in(const RestOrder& then) const {
  std::vector<int> out(rows_.size(), -1);
  std::iota(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(num_lasting_), 0);
  std::map<model::NearPair, std::size_t> first_then;
  std::size_t place = num_lasting_;
  for (const PairRows& pair : then) {
    first_then.emplace(pair.pair, place);
    place += pair.count;
  }
  auto row = out.begin() + static_cast<std::ptrdiff_t>(num_lasting_);
  for (const PairRows& pair : order_) {
    const auto end = row + static_cast<std::ptrdiff_t>(pair.count);
    const auto known = first_then.find(pair.pair);
    if (known != first_then.end()) std::iota(row, end, static_cast<int>(known->second));
    row = end;
  }
  return out;
}

RestStands RestRows::carried(const RestOrder& then, const RestStands& stands) const {
  RestStands out(rows_.size());
  const std::vector<int> places = places_in(then);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (places[k] >= 0) out[k] = stands[static_cast<std::size_t>(places[k])];
  }
  return out;
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
  } else if (dynamic_cast<const loads::BallFriction*>(element) != nullptr) {
    row.is_angle = true;
    for (row.part = 0; row.part < 3; ++row.part) rows_.push_back(row);
  } else if (dynamic_cast<const loads::ReactionFollower*>(element) != nullptr) {
    rows_.push_back(row);
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

void RestRows::add_pairs(std::size_t load) {
  RestRow row{Kind::along, load};
  for (std::size_t g = 0; g < model_.contact_groups.size(); ++g) {
    const model::ContactGroup& group = *model_.contact_groups[g];
    if (group.load != load) continue;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      for (std::size_t j = i + 1; j < group.members.size(); ++j) {
        if (!group.can_touch(i, j)) continue;
        const auto [first, second] = group.ordered(i, j);
        row.pair = static_cast<int>(pairs_.size());
        pairs_.push_back({static_cast<int>(g), static_cast<int>(first), static_cast<int>(second)});
        const int count = group.contact(first, second).num_soft_rows();
        for (row.part = 0; row.part < count; ++row.part) {
          if (row.part % RestRow::kOfSpot != 0) rows_.push_back(row);
        }
      }
    }
  }
}

/// @param soft scratch: rows of the same pair, of the row before
void RestRows::evaluate_pair(std::size_t k, const std::vector<dynamics::BodyMotion>& motions,
                             double t, std::vector<loads::SoftRow>& soft, RestValues& out) const {
  const RestRow& row = rows_[k];
  const model::NearPair& pair = pairs_[static_cast<std::size_t>(row.pair)];
  const model::ContactGroup& group = *model_.contact_groups[static_cast<std::size_t>(pair.group)];
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  const model::MarkerId &first = group.members[i].marker, &second = group.members[j].marker;
  const auto first_at = dynamics::evaluate_marker(model_, first, motions);
  const auto second_at = dynamics::evaluate_marker(model_, second, motions);
  if (k == 0 || rows_[k - 1].pair != row.pair) {
    soft.clear();
    group.contact(i, j).append_tangent({t, first_at.motion, second_at.motion}, soft);
  }
  const spatial::PairRow& J = soft[static_cast<std::size_t>(row.part)].J;
  const auto spot = static_cast<std::size_t>(row.part - row.part % RestRow::kOfSpot);
  out.presses[k] = soft[spot].stiffness > 0.0 ? 1 : 0;
  out.rows.push_back(dynamics::system_row(model_, first, first_at, second, second_at, J));
  out.values.push_back(0.0);
  out.pushes.emplace_back(J.segment<3>(9).transpose());
}

void RestRows::evaluate(const std::vector<dynamics::BodyMotion>& motions, double t,
                        RestValues& out) const {
  out.rows.clear();
  out.values.clear();
  out.pushes.clear();
  out.contacts.assign(rows_.size(), {});
  out.presses.assign(rows_.size(), 0);
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
      soft.clear();
      load.element->append_tangent(sight, soft);
      J = soft[static_cast<std::size_t>(row.part)].J;
      const auto spot = static_cast<std::size_t>(row.part - row.part % RestRow::kOfSpot);
      out.presses[k] = soft[spot].stiffness > 0.0 ? 1 : 0;
    }
    out.rows.push_back(rest_row_of(model_, load, ends, J));
    out.values.push_back(sight.coordinate.value);
    out.pushes.emplace_back(J.segment<3>(9).transpose());
    if (row.kind == Kind::one_sided) {
      out.contacts[k] = stop_at(model_, row).contact(sight.coordinate.value);
    }
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

RestStands RestRows::start(const RestValues& values) const {
  RestStands out(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (touches(k, values)) out[k].regime = values.contacts[k].regime;
    if (rows_[k].kind == Kind::held) out[k].regime = 1;
  }
  follow_contacts(values, out);
  return out;
}

void RestRows::share(const RestValues& values, RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    stands[k].force = 0.0;
    if (rows_[k].kind != Kind::one_sided || values.contacts[k].gap > kSharing * length_of(k)) {
      continue;
    }
    stands[k].regime = values.contacts[k].regime;
  }
  follow_contacts(values, stands);
}

void RestRows::follow_contacts(const RestValues& values, RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::along) continue;
    if (rows_[k].across < 0) {
      stands[k].regime = values.presses[k];
      continue;
    }
    const auto across = static_cast<std::size_t>(rows_[k].across);
    stands[k].regime = stands[across].regime != 0 && touches(across, values) ? 1 : 0;
  }
}

void RestRows::open_unloaded(double force, RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::one_sided) continue;
    if (push(k, stands[k]) * (rows_[k].is_angle ? 1.0 / model_.length : 1.0) <= force) {
      stands[k].regime = 0;
    }
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::along || rows_[k].across < 0) continue;
    if (stands[static_cast<std::size_t>(rows_[k].across)].regime == 0) stands[k].regime = 0;
  }
}

double RestRows::deepest(const RestValues& values, const RestStands& stands) const {
  double out = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::one_sided || stands[k].regime != 0) continue;
    out = std::max(out, -values.contacts[k].gap / length_of(k));
  }
  return out;
}

double RestRows::strongest_pull(const RestStands& stands) const {
  double out = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const double lever = rows_[k].is_angle ? model_.length : 1.0;
    out = std::max(out, -push(k, stands[k]) / lever);
  }
  return out;
}

double RestRows::strongest(const RestStands& stands) const {
  double out = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    out = std::max(out, std::abs(stands[k].force) / (rows_[k].is_angle ? model_.length : 1.0));
  }
  return out;
}

RestStands RestRows::of_loads(const RestValues& values, const RestStands& stands) const {
  RestStands out;
  if (rows_.empty()) return out;
  out.resize(model_.loads.size());
  // Each pair of bodies by itself.
  std::map<std::pair<std::size_t, int>, Eigen::Vector3d> sums;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const std::size_t load = rows_[k].load;
    if (model_.loads[load].coordinate >= 0) {
      out[load] = stands[k];
    } else {
      sums.try_emplace({load, rows_[k].pair}, Eigen::Vector3d::Zero()).first->second +=
          stands[k].force * values.pushes[k];
    }
  }
  for (const auto& [of, sum] : sums) out[of.first] = {1, out[of.first].force + sum.norm()};
  return out;
}

std::string RestRows::unloaded(const RestValues& values, const RestStands& stands,
                               double force) const {
  std::map<std::string, bool> presses;  // of what touches
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!touches(k, values)) continue;
    const double lever = rows_[k].is_angle ? model_.length : 1.0;
    presses[name(k)] = presses[name(k)] || push(k, stands[k]) / lever > force;
  }
  std::string out;
  for (const auto& [name, is_pressed] : presses) {
    if (!is_pressed) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", name);
  }
  return out;
}

std::vector<std::string> RestRows::overlaps(const RestValues& values) const {
  std::map<std::string, std::pair<double, bool>> deepest;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::one_sided) continue;
    const double depth = -values.contacts[k].gap;
    if (depth <= kLargeOverlap * length_of(k)) continue;
    auto& worst = deepest[name(k)];
    worst = {std::max(worst.first, depth), rows_[k].is_angle};
  }
  std::vector<std::string> out;
  for (const auto& [name, worst] : deepest) {
    out.push_back(
        fmt::format("load \"{}\" starts {:.3g} {} beyond its end; the static equilibrium begins by "
                    "pushing it out; place the bodies apart",
                    name, worst.first, worst.second ? "rad" : "m"));
  }
  return out;
}

}  // namespace buckens::analysis
