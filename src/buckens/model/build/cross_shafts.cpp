// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/cross_shafts.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

// Cosine of the largest angle between shafts: of 85 degrees.
constexpr double kLargestBend = 0.08715574274765817;

/// What holds a shaft: the bearing, the body on which it is, and its axis in the world as placed.
struct Bearing {
  const Joint* joint = nullptr;
  int on = kGround;
  Vector3d axis;
};

std::vector<Bearing> bearings_of(int body, MarkerFinder& find) {
  using joints::JointType;
  std::vector<Bearing> out;
  for (const Joint& joint : find.model().joints) {
    const bool holds = joint.type == JointType::revolute || joint.type == JointType::cylindrical ||
                       joint.type == JointType::screw;
    if (!holds || joint.is_tie) continue;
    if (joint.first.body != body && joint.second.body != body) continue;
    const int other = joint.first.body == body ? joint.second.body : joint.first.body;
    out.push_back({&joint, other, find.placed(joint.first).R() * joint.axis_F});
  }
  return out;
}

}  // namespace

void require_bent_shafts(MarkerFinder& find) {
  for (const Joint& cross : find.model().joints) {
    if (cross.type != joints::JointType::universal) continue;
    if (cross.first.body == kGround || cross.second.body == kGround) continue;
    for (const Bearing& one : bearings_of(cross.first.body, find)) {
      for (const Bearing& two : bearings_of(cross.second.body, find)) {
        const double cosine = std::abs(one.axis.dot(two.axis));
        if (one.on != two.on || cosine >= kLargestBend) continue;
        throw ModelError(
            cross.where,
            fmt::format(
                "joint \"{}\": the shafts that it connects, in joints \"{}\" and \"{}\", meet at "
                "{:.4g} degrees; a universal joint is singular at 90 degrees and passes on no "
                "rotation there; bend the shafts by less than 85 degrees, or use a `gear` or a "
                "`coupler`",
                cross.name, one.joint->name, two.joint->name,
                std::acos(cosine) * 180.0 / std::numbers::pi));
      }
    }
  }
}

}  // namespace buckens::model
