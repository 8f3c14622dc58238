// SPDX-License-Identifier: Apache-2.0
// Laws that are evaluated with the rows of their joint.
#include <algorithm>
#include <utility>

#include "buckens/dynamics/citing.h"
#include "buckens/dynamics/joint_set.h"

namespace buckens::dynamics {

using spatial::Wrench;

namespace {

/// Adds what a force along a joint coordinate does to both markers.
void add_along(const spatial::PairRow& J, double force, JointWrenches& out) {
  out.on_first.torque += force * J.segment<3>(0).transpose();
  out.on_first.force += force * J.segment<3>(3).transpose();
  out.on_second.torque += force * J.segment<3>(6).transpose();
  out.on_second.force += force * J.segment<3>(9).transpose();
}

}  // namespace

void JointSet::take_laws() {
  is_law_.assign(model_.loads.size(), 0);
  std::vector<std::pair<std::size_t, Law>> found;  // with their joints
  int place = 0;                                   // in Forces::regimes
  int soft = 0;
  for (std::size_t k = 0; k < model_.loads.size(); ++k) {
    const model::Load& load = model_.loads[k];
    const int regime = has_regimes(load) ? place++ : -1;
    const int first_soft = soft;
    soft += load.element->num_soft_rows();
    is_soft_row_.resize(static_cast<std::size_t>(soft), 0);
    if (load.joint < 0) continue;
    const auto j = static_cast<std::size_t>(load.joint);
    // Signals and values from outside are those of all loads at an instant.
    const bool is_plain = joints_[j].num_coupled == 0 && joints_[j].slider == nullptr &&
                          !load.element->uses_signals() && !load.element->takes_values();
    if (!is_plain) continue;
    is_law_[k] = 1;
    std::fill(is_soft_row_.begin() + first_soft, is_soft_row_.end(), 1);
    const auto* follows = dynamic_cast<const loads::ReactionFollower*>(load.element.get());
    const auto* along = dynamic_cast<const loads::CoordinateLaw*>(load.element.get());
    const bool has_state = along != nullptr && along->num_states() > 0;
    found.push_back({j, {k, regime, first_soft, follows, along, has_state}});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t n = found.size(); n-- > 0;) {
    joints_[found[n].first].laws = n;
    ++joints_[found[n].first].num_laws;
  }
  law_of_load_.assign(model_.loads.size(), 0);
  for (const auto& [joint, law] : found) {
    law_of_load_[law.load] = laws_.size();
    laws_.push_back(law);
  }
}

void JointSet::append_soft_rows(std::size_t load, const std::vector<BodyMotion>& motions, double t,
                                const Circumstances& around, SoftRows& out,
                                std::vector<ReactionSlope>* slopes) const {
  const auto j = static_cast<std::size_t>(model_.loads[load].joint);
  const Joint& joint = joints_[j];
  const Law& law = laws_[law_of_load_[load]];
  const Motion F = motion_of(joint.first, motions), M = motion_of(joint.second, motions);
  const bool is_released = around.memory != nullptr && around.memory->is_released(j);
  const bool has_reaction = around.lambda != nullptr && around.lambda->size() > 0;
  std::array<Wrench, kMostRows> units;
  Wrench reaction;
  if (!is_released && (has_reaction || slopes != nullptr)) {
    thread_local JointResiduals unused;  // kept, so that steps allocate nothing
    for (linalg::Vector* values : {&unused.g, &unused.g_dot, &unused.g_t})
      values->resize(num_rows_);
    const double* const states = around.memory != nullptr && around.memory->rows.size() > 0
                                     ? around.memory->rows.data()
                                     : nullptr;
    reaction = evaluate_rows(j, F, M, t, states, has_reaction ? around.lambda : nullptr, unused,
                             slopes != nullptr ? units.data() : nullptr)
                   .on_second;
  }
  const Look look{F, M, F.marker(joint.first), M.marker(joint.second)};
  const loads::Sight sight =
      sight_at_joint(model_, load, t, around, look.first, look.second, reaction);
  const bool is_off = around.memory != nullptr && around.memory->is_off(load);
  const int regime = append_tangent(joint, law, look, sight, is_off, out);
  if (slopes != nullptr && law.follows != nullptr && !is_off && !is_released) {
    append_slopes(joint, law, sight, regime, units.data(), *slopes);
  }
}

int JointSet::append_tangent(const Joint& joint, const Law& law, const Look& look,
                             const loads::Sight& sight, bool is_off, SoftRows& out) const {
  const model::Load& own = model_.loads[law.load];
  out.of_one.clear();
  const int regime =
      citing(own, [&] { return own.element->append_tangent_in_regime(sight, out.of_one); });
  if (is_off) give_nothing(out.of_one);
  if (law.regime >= 0) out.regimes.push_back(is_off ? 0 : regime);
  const bool may_mix = out.of_one.size() > 1 || own.rigid_row >= 0;
  if (!is_off && may_mix) append_mix(*own.element, sight, out);
  for (const loads::SoftRow& row : out.of_one) {
    SystemRow& place = out.rows.emplace_back();
    derive(joint.first, look.F, {row.J.segment<3>(0).transpose(), row.J.segment<3>(3).transpose()},
           place.first);
    derive(joint.second, look.M, {row.J.segment<3>(6).transpose(), row.J.segment<3>(9).transpose()},
           place.second);
    out.stiffness.push_back(row.stiffness);
    out.damping.push_back(row.damping);
    out.rigid.push_back(own.rigid_row);
    out.is_closed.push_back(row.is_rigid ? 1 : 0);
  }
  return regime;
}

void JointSet::append_slopes(const Joint& joint, const Law& law, const loads::Sight& sight,
                             int regime, const Wrench* units, std::vector<ReactionSlope>& out) {
  thread_local std::vector<Wrench> slopes;  // kept, so that steps allocate nothing
  slopes.clear();
  law.follows->append_slopes(sight, regime, slopes);
  for (std::size_t n = 0; n < slopes.size(); ++n) {
    for (int k = 0; k < joint.num_rows; ++k) {
      const double value =
          units[k].torque.dot(slopes[n].torque) + units[k].force.dot(slopes[n].force);
      if (value == 0.0) continue;
      ReactionSlope& slope = out.emplace_back();
      slope.soft = law.soft + static_cast<int>(n);
      slope.row = joint.first_row + k;
      slope.value = value;
    }
  }
}

void JointSet::act(const Joint& joint, const Look& look, double t, const Laws& with,
                   const Wrench* units, JointWrenches& wrenches, Forces& forces) const {
  const Wrench reaction = wrenches.on_second;
  for (std::size_t n = joint.laws; n < joint.laws + joint.num_laws; ++n) {
    const Law& law = laws_[n];
    const bool is_off = with.around.memory != nullptr && with.around.memory->is_off(law.load);
    if (is_off && with.soft == nullptr) continue;
    joints::CountedValue coordinate;
    const loads::Sight sight = sight_at_joint(model_, law.load, t, with.around, look.first,
                                              look.second, reaction, &coordinate);
    if (with.soft != nullptr) {
      SoftRows& soft = (*with.soft)[n];
      soft.clear();
      append_tangent(joint, law, look, sight, is_off, soft);
      if (is_off) continue;
    }
    const int number = model_.loads[law.load].coordinate;
    if (with.ends != nullptr && number >= 0) {
      // Here and below written one by one: a copy of the whole waits for its parts.
      LawEnds::Coordinate& end = with.ends->coordinates[static_cast<std::size_t>(number)];
      end.is_known = true;
      end.value.turns = coordinate.turns;
      end.value.fraction = coordinate.fraction;
      end.value.rate = coordinate.rate;
      end.value.t = coordinate.t;
    }
    const int regime = add_response(law, sight, with.ends, wrenches, forces);
    if (units != nullptr && law.follows != nullptr) {
      append_slopes(joint, law, sight, regime, units, *with.slopes);
    }
  }
}

int JointSet::add_response(const Law& law, const loads::Sight& sight, LawEnds* ends,
                           JointWrenches& wrenches, Forces& forces) const {
  const model::Load& load = model_.loads[law.load];
  const auto count = [&](const auto& response) {
    forces.stored_energy += response.stored_energy;
    forces.active_power += response.active_power;
    forces.dissipation += response.dissipation;
    if (law.regime >= 0) forces.regimes[static_cast<std::size_t>(law.regime)] = response.regime;
    return response.regime;
  };
  if (law.along == nullptr) {
    const loads::Action action = citing(load, [&] { return load.element->respond(sight); });
    wrenches.on_first += action.on_first;
    wrenches.on_second += action.on_second;
    if (load.rigid_row >= 0) forces.rigid[static_cast<std::size_t>(load.rigid_row)] = action.row;
    return count(action);
  }
  const loads::CoordinateResponse response = citing(load, [&] { return law.along->answer(sight); });
  add_along(sight.coordinate.J, response.force, wrenches);
  if (ends != nullptr && law.has_state)
    ends->laws[law.load] = {true, response.strain, response.force};
  return count(response);
}

}  // namespace buckens::dynamics
