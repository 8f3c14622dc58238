// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/friction_of_step.h"

namespace buckens::stepping {

void FrictionOfStep::take(const Instant& evaluated, const Instant& end,
                          const dynamics::Circumstances& around, const dynamics::LawEnds* ends) {
  const bool same = scheme_.weight == 1.0;
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const std::size_t k = loads_[n];
    dynamics::JointRub& rub = rubs_[n];
    const int coordinate = model_.loads[k].coordinate;
    if (ends != nullptr && coordinate >= 0 && ends->knows_law(k) &&
        ends->knows_coordinate(static_cast<std::size_t>(coordinate))) {
      rub.force[0] = ends->laws[k].force;
      rub.rate[0] = ends->coordinates[static_cast<std::size_t>(coordinate)].value.rate;
      continue;
    }
    rub = dynamics::joint_rub(model_, k, evaluated.motions, evaluated.t, around);
    if (!same) {
      rub.rate = dynamics::joint_rub_rate(model_, k, end.motions, end.t, around.memory);
    }
  }
}

}  // namespace buckens::stepping
