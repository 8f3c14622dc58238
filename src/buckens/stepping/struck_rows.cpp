// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/struck_rows.h"

#include <cmath>

#include "buckens/dynamics/travel.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::stepping {

namespace {

// Share of the speeds of both markers that is rounding of the rate between them.
constexpr double kRoundingOfStruck = 1e-9;

/// Speeds of both markers along a coordinate, whatever their signs [m/s] or [rad/s].
double speeds_along(const loads::Sight& sight) {
  const spatial::PairRow& J = sight.coordinate.J;
  return std::abs(J.segment<3>(0).dot(sight.first.w)) +
         std::abs(J.segment<3>(3).dot(sight.first.v)) +
         std::abs(J.segment<3>(6).dot(sight.second.w)) +
         std::abs(J.segment<3>(9).dot(sight.second.v));
}

/// How fast a ball turns, as a vector [rad/s].
Eigen::Vector3d turning_of_ball(const loads::Sight& sight) {
  return sight.second.w - sight.first.w;
}

/// What an impact has done to the rate that a law looks at: of a ball all of them, for its three
/// rows to follow alike.
struct Blow {
  double change, rounding;  // [m/s] or [rad/s]
};
Blow blow_on(const loads::RigidLaw& law, const loads::Sight& before, const loads::Sight& after) {
  if (law.row_of_ball() < 0) {
    return {std::abs(after.coordinate.rate - before.coordinate.rate),
            kRoundingOfStruck * (speeds_along(before) + speeds_along(after))};
  }
  double speeds = 0.0;
  for (const loads::Sight* sight : {&before, &after}) {
    speeds += sight->first.w.norm() + sight->second.w.norm();
  }
  return {(turning_of_ball(after) - turning_of_ball(before)).norm(), kRoundingOfStruck * speeds};
}

}  // namespace

void follow_struck_rows(const model::Model& model, const std::vector<dynamics::BodyMotion>& before,
                        const std::vector<dynamics::BodyMotion>& after, double t,
                        const dynamics::Circumstances& around, model::RowMemory& memory) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    if (load.rigid_row < 0 || load.coordinate < 0 || memory.is_off(k)) continue;
    const auto& law = static_cast<const loads::RigidLaw&>(*load.element);
    // Impacts have decided themselves where stops and contacts go on.
    if (law.contact(0.0).regime != 0 || law.row_of_place() >= 0) continue;
    const dynamics::LoadEnds ends_before = dynamics::ends_of(model, load, before, around.memory);
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, after, around.memory);
    const loads::Sight struck = dynamics::sight_of(model, k, t, around, ends_before);
    loads::Sight sight = dynamics::sight_of(model, k, t, around, ends);
    const Blow blow = blow_on(law, struck, sight);
    if (blow.change <= blow.rounding) continue;
    const int regime = law.struck_regime(sight, blow.rounding);
    if (regime == sight.stand.regime) continue;
    sight.stand = {regime, 0.0};
    law.find_states(sight, memory.laws.data() + load.first_state);
  }
}

}  // namespace buckens::stepping
