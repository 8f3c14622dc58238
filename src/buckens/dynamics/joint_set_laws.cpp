// SPDX-License-Identifier: Apache-2.0
// Laws that are evaluated with the rows of their joint.
#include <algorithm>
#include <utility>

#include "buckens/dynamics/citing.h"
#include "buckens/dynamics/joint_set.h"

namespace buckens::dynamics {

using spatial::Wrench;

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
    found.push_back({j, {k, regime, first_soft, follows}});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t n = found.size(); n-- > 0;) {
    joints_[found[n].first].laws = n;
    ++joints_[found[n].first].num_laws;
  }
  for (const auto& [joint, law] : found) laws_.push_back(law);
}

void JointSet::append_slopes(const Joint& joint, const Law& law, const loads::Sight& sight,
                             const Wrench* units, std::vector<ReactionSlope>& out) {
  thread_local std::vector<Wrench> slopes;  // kept, so that steps allocate nothing
  slopes.clear();
  law.follows->append_slopes(sight, slopes);
  for (std::size_t n = 0; n < slopes.size(); ++n) {
    for (int k = 0; k < joint.num_rows; ++k) {
      const double value =
          units[k].torque.dot(slopes[n].torque) + units[k].force.dot(slopes[n].force);
      if (value == 0.0) continue;
      out.push_back({law.soft + static_cast<int>(n), joint.first_row + k, -1, value});
    }
  }
}

void JointSet::act(const Joint& joint, const Markers& markers, double t, const Laws& with,
                   const Wrench* units, JointWrenches& wrenches, Forces& forces) const {
  const Wrench reaction = wrenches.on_second;
  for (std::size_t n = joint.laws; n < joint.laws + joint.num_laws; ++n) {
    const Law& law = laws_[n];
    if (with.around.memory != nullptr && with.around.memory->is_off(law.load)) continue;
    const model::Load& load = model_.loads[law.load];
    const loads::Sight sight =
        sight_at_joint(model_, law.load, t, with.around, markers.first, markers.second, reaction);
    const loads::Action action = citing(load, [&] { return load.element->respond(sight); });
    wrenches.on_first += action.on_first;
    wrenches.on_second += action.on_second;
    forces.stored_energy += action.stored_energy;
    forces.active_power += action.active_power;
    forces.dissipation += action.dissipation;
    if (law.regime >= 0) forces.regimes[static_cast<std::size_t>(law.regime)] = action.regime;
    if (load.rigid_row >= 0) forces.rigid[static_cast<std::size_t>(load.rigid_row)] = action.row;
    if (units != nullptr && law.follows != nullptr) {
      append_slopes(joint, law, sight, units, *with.slopes);
    }
  }
}

}  // namespace buckens::dynamics
