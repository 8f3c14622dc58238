// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/reaction_slopes.h"

#include "buckens/dynamics/travel.h"

namespace buckens::dynamics {

namespace {

/// Appends the derivatives of the force of one soft row.
/// @param slope derivatives by the joint's reaction, @param sight as the law sees it
void append_slopes_of_row(const model::Joint& joint, int soft, const spatial::Wrench& slope,
                          const loads::Sight& sight, const double* states, const Travel* travel,
                          std::vector<ReactionSlope>& out) {
  if (slope.force.isZero(0.0) && slope.torque.isZero(0.0)) return;
  for (std::size_t k = 0; k < joint.rows.size(); ++k) {
    const joints::ConstraintRow& row = joint.rows[k];
    double value = 0.0;
    if (travel != nullptr) {
      value = slope.force.dot(travel->row(row, sight.t).e);
    } else {
      const spatial::PairRow J = row.evaluate(sight.first, sight.second, sight.t, states).J;
      value = J.segment<3>(6).dot(slope.torque) + J.segment<3>(9).dot(slope.force);
      if (states != nullptr) states += row.num_states();
    }
    if (value != 0.0) out.push_back({soft, joint.first_row + static_cast<int>(k), -1, value});
  }
}

}  // namespace

ReactionSlopes::ReactionSlopes(const model::Model& model) : model_(model) {
  for (const model::Load& load : model.loads) {
    followers_.push_back(load.joint < 0
                             ? nullptr
                             : dynamic_cast<const loads::ReactionFollower*>(load.element.get()));
    rubbing_.push_back(dynamic_cast<const loads::ContactFriction*>(load.element.get()));
  }
}

void ReactionSlopes::append(std::size_t load, int soft, int regime, const loads::Sight& sight,
                            const Circumstances& around, const Travel* travel,
                            std::vector<ReactionSlope>& out) const {
  if (const loads::ReactionFollower* law = followers_[load]) {
    const model::Joint& joint = model_.joints[static_cast<std::size_t>(model_.loads[load].joint)];
    thread_local std::vector<spatial::Wrench> slopes;  // kept, so that steps allocate nothing
    slopes.clear();
    law->append_slopes(sight, regime, slopes);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      append_slopes_of_row(joint, soft + static_cast<int>(k), slopes[k], sight,
                           states_of(joint, around.memory), travel, out);
    }
  }
  if (const loads::ContactFriction* law = rubbing_[load]) {
    const double slope = law->slope(sight);
    if (slope == 0.0) return;
    // The force across the surface counts positive where it pushes, whatever its row is.
    const int across = soft - 1 - law->direction();
    const auto& row = model_.loads[load - 1 - static_cast<std::size_t>(law->direction())];
    const auto& stop = static_cast<const loads::RigidLaw&>(*row.element);
    out.push_back({soft, -1, across, slope * stop.contact(0.0).sign});
  }
}

}  // namespace buckens::dynamics
