// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/joint_rub.h"

#include "buckens/dynamics/citing.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/coordinate_motor.h"
#include "buckens/loads/reaction_follower.h"

namespace buckens::dynamics {

using Eigen::Vector3d;

std::vector<std::size_t> rubbing_joints(const model::Model& model) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const loads::ForceElement* const element = model.loads[k].element.get();
    const bool rubs = dynamic_cast<const loads::ReactionFollower*>(element) != nullptr ||
                      dynamic_cast<const loads::CoordinateBrake*>(element) != nullptr;
    if (rubs) out.push_back(k);
  }
  return out;
}

JointRub joint_rub(const model::Model& model, std::size_t load,
                   const std::vector<BodyMotion>& motions, double t, const Circumstances& around) {
  JointRub out;
  const model::Load& own = model.loads[load];
  const LoadEnds ends = ends_of(model, own, motions, around.memory);
  citing(own, [&] {
    const loads::Sight sight = sight_of(model, load, t, around, ends);
    const bool is_along = own.coordinate >= 0;
    out.rate = is_along ? Vector3d(sight.coordinate.rate, 0.0, 0.0)
                        : Vector3d(sight.second.w - sight.first.w);
    if (around.memory != nullptr && around.memory->is_off(load)) return;
    const loads::Action action = own.element->respond(sight);
    out.force = is_along ? Vector3d(action.along_coordinate, 0.0, 0.0) : action.on_second.torque;
  });
  return out;
}

Vector3d joint_rub_rate(const model::Model& model, std::size_t load,
                        const std::vector<BodyMotion>& motions, double t,
                        const model::RowMemory* memory) {
  const model::Load& own = model.loads[load];
  if (own.coordinate >= 0) {
    const auto coordinate = static_cast<std::size_t>(own.coordinate);
    return {coordinate_motion(model, coordinate, t, memory, motions).rate, 0.0, 0.0};
  }
  const LoadEnds ends = ends_of(model, own, motions, memory);
  return ends.second.motion.w - ends.first.motion.w;
}

}  // namespace buckens::dynamics
