// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/rigid_contact_rows.h"

#include <algorithm>
#include <cmath>

#include "buckens/joints/contact_way.h"
#include "buckens/loads/contact_stop.h"

namespace buckens::model {

namespace {

// Slip whose direction says nothing, in sizes of the smaller shape per second.
constexpr double kNoSlip = 1e-9;

}  // namespace

std::vector<RigidContactRow> rigid_contact_rows(const Load& like,
                                                const std::vector<spatial::RigidTouch>& touches,
                                                const RigidPairLaw& law, double size) {
  using Direction = joints::ContactWay::Direction;
  std::vector<RigidContactRow> out;
  const auto add = [&](const spatial::RigidTouch& touch, Direction direction,
                       std::shared_ptr<const loads::ForceElement> element) {
    RigidContactRow row;
    row.load = like;
    row.load.element = std::move(element);
    row.coordinate = {
        -1, like.first, like.second,
        joints::JointCoordinate::gap(std::make_shared<joints::ContactWay>(touch, direction))};
    out.push_back(std::move(row));
  };
  loads::ContactFrictionData friction;
  friction.static_coefficient = law.static_coefficient;
  friction.dynamic_coefficient = law.dynamic_coefficient;
  friction.stribeck_speed = law.stribeck_speed;
  friction.at_rest = kNoSlip * size;
  const double threshold = law.threshold.value_or(loads::RigidStop::kAtRest * size);
  for (const spatial::RigidTouch& touch : touches) {
    add(touch, Direction::across,
        std::make_shared<loads::ContactStop>(touch, law.restitution, threshold, law.settings));
    if (law.static_coefficient == 0.0) continue;
    for (int k = 0; k < touch.num_directions(); ++k) {
      add(touch, k == 0 ? Direction::along : Direction::other_along,
          std::make_shared<loads::ContactFriction>(touch, friction, k, law.settings));
    }
  }
  return out;
}

double least_gap(const std::vector<spatial::RigidTouch>& touches, const joints::Placement& placed) {
  spatial::MarkerMotion F, M;
  M.p = placed.r_F;
  M.R = placed.R_WF.transpose() * placed.R_WM;
  double gap = HUGE_VAL;
  for (const spatial::RigidTouch& touch : touches) gap = std::min(gap, touch.look(F, M).gap);
  return gap;
}

RigidPairLaw rigid_pair_law(const loads::ContactForceSpec& spec) {
  RigidPairLaw out;
  out.restitution = spec.restitution.value_or(0.0);
  out.threshold = spec.threshold;
  out.static_coefficient = spec.coefficient;
  out.dynamic_coefficient = spec.dynamic.value_or(spec.coefficient);
  out.stribeck_speed = spec.stribeck.value_or(0.0);
  out.settings = spec.settings;
  return out;
}

}  // namespace buckens::model
