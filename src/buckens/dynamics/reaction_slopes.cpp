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
  int soft = 0;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const auto* law = dynamic_cast<const loads::ReactionFollower*>(load.element.get());
    if (law != nullptr && load.joint >= 0) followers_.push_back({k, soft, law});
    const auto* rubbing = dynamic_cast<const loads::ContactFriction*>(load.element.get());
    if (rubbing != nullptr) rubbing_.push_back({k, soft, rubbing});
    soft += load.element->num_soft_rows();
  }
}

void ReactionSlopes::evaluate(const std::vector<BodyMotion>& motions, double t,
                              const Circumstances& around, std::vector<ReactionSlope>& out) const {
  out.clear();
  thread_local std::vector<spatial::Wrench> slopes;  // kept, so that steps allocate nothing
  for (const Follower& follower : followers_) {
    if (around.memory != nullptr && around.memory->is_off(follower.load)) continue;
    const model::Load& load = model_.loads[follower.load];
    const model::Joint& joint = model_.joints[static_cast<std::size_t>(load.joint)];
    const LoadEnds ends = ends_of(model_, load, motions, around.memory);
    const loads::Sight sight = sight_of(model_, follower.load, t, around, ends.first.motion,
                                        ends.second.motion, ends.travels());
    slopes.clear();
    follower.law->append_slopes(sight, slopes);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      append_slopes_of_row(joint, follower.soft + static_cast<int>(k), slopes[k], sight,
                           states_of(joint, around.memory), ends.travels(), out);
    }
  }
  for (const Rubbing& one : rubbing_) {
    if (around.memory != nullptr && around.memory->is_off(one.load)) continue;
    const model::Load& load = model_.loads[one.load];
    const LoadEnds ends = ends_of(model_, load, motions, around.memory);
    const double slope = one.law->slope(sight_of(model_, one.load, t, around, ends));
    if (slope == 0.0) continue;
    // The force across the surface counts positive where it pushes, whatever its row is.
    const int across = one.soft - 1 - one.law->direction();
    const auto& row = model_.loads[one.load - 1 - static_cast<std::size_t>(one.law->direction())];
    const auto& stop = static_cast<const loads::RigidLaw&>(*row.element);
    out.push_back({one.soft, -1, across, slope * stop.contact(0.0).sign});
  }
}

}  // namespace buckens::dynamics
