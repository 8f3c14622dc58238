// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/held_laws.h"

#include <algorithm>

#include "buckens/dynamics/travel.h"
#include "buckens/loads/end_of_set.h"

namespace buckens::stepping {

HeldLaws::HeldLaws(const model::Model& model) : model_(model), balls_(model) {
  std::size_t regime = 0;
  int soft = 0;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const auto* law = dynamic_cast<const loads::CoordinateLaw*>(load.element.get());
    if (law != nullptr && load.coordinate >= 0) laws_.push_back({k, regime, soft, law});
    if (load.coordinate >= 0 || load.element->num_states() > 0) ++regime;
    soft += load.element->num_soft_rows();
  }
  held_.reserve(laws_.size());
}

loads::UnlimitedForce HeldLaws::look(const Law& law,
                                     const std::vector<dynamics::BodyMotion>& motions, double t,
                                     const dynamics::Circumstances& around) const {
  const dynamics::LoadEnds ends =
      dynamics::ends_of(model_, model_.loads[law.load], motions, around.memory);
  return law.element->unlimited(dynamics::sight_of(model_, law.load, t, around, ends.first.motion,
                                                   ends.second.motion, ends.travels()));
}

void HeldLaws::hold_reversed(const std::vector<int>& before,
                             const std::vector<dynamics::BodyMotion>& motions, double t,
                             const dynamics::Circumstances& around, dynamics::SoftRows& tangents) {
  held_.clear();
  for (const Law& law : laws_) {
    const int end = loads::EndOfSet::of(tangents.regimes[law.regime]);
    if (end * loads::EndOfSet::of(before[law.regime]) != -1) continue;
    const loads::UnlimitedForce force = look(law, motions, t, around);
    if (!(force.stiffness > 0.0 || force.damping > 0.0)) continue;
    const auto row = static_cast<std::size_t>(law.soft);
    tangents.stiffness[row] = force.stiffness;
    tangents.damping[row] = force.damping;
    tangents.regimes[law.regime] = 0;
    held_.push_back(law);
  }
  balls_.hold_reversed(motions, t, around, tangents);
}

bool HeldLaws::holds(int soft) const {
  return std::any_of(held_.begin(), held_.end(),
                     [&](const Law& law) { return law.soft == soft; }) ||
         balls_.holds(soft);
}

}  // namespace buckens::stepping
