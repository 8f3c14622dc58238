// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/placed_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/joints/flank_gap.h"

namespace buckens::joints {

using Eigen::Vector3d;

namespace {
// Largest cosine between a rack and the axis of its pinion that counts as a right angle.
constexpr double kAcrossPinion = 1e-4;
// Share of a pitch that at least is left to teeth: spaces are half of it without any play.
constexpr double kMostPlay = 0.5;
}  // namespace

std::shared_ptr<const GearMesh> placed_gear(JointType type, const Vector3d& axis_F,
                                            const Placement& placement) {
  GearMesh::Data data;
  data.axis_F = axis_F;
  data.r_F = placement.r_F;
  data.R_FM = placement.R_WF.transpose() * placement.R_WM;
  data.sizes = placement.sizes;
  data.same_sense = placement.same_sense;
  data.has_teeth = type == JointType::gear;
  data.pressure_angle = placement.pressure_angle;
  data.helix_angle = placement.helix_angle;
  return std::make_shared<GearMesh>(data);
}

std::shared_ptr<const RackMesh> placed_rack(const Vector3d& axis_F, const Placement& placement) {
  const Vector3d along = placement.second_axis_F.value_or(Vector3d::Zero());
  if (!(along.norm() > 0.0)) {
    throw ModelError("`along` has no direction; give three numbers, not all zero");
  }
  const double cosine = along.normalized().dot(axis_F);
  if (std::abs(cosine) > kAcrossPinion) {
    throw ModelError(fmt::format(
        "a rack runs across the axis of its pinion; `along` and `axis` meet at {:.4g} degrees; "
        "turn one of them",
        std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi));
  }
  RackMesh::Data data;
  data.axis_F = axis_F;
  data.along_F = (along - along.dot(axis_F) * axis_F).normalized();
  data.r_F = placement.r_F;
  data.R_FM = placement.R_WF.transpose() * placement.R_WM;
  data.radius = placement.sizes[0];
  data.pressure_angle = placement.pressure_angle;
  data.helix_angle = placement.helix_angle;
  return std::make_shared<RackMesh>(data);
}

FlankGaps make_flank_gaps(JointType type, const Placement& placement, double backlash) {
  FlankGap::Data data;
  const Vector3d axis = unit_axis(placement);
  if (type == JointType::gear) {
    const auto mesh = placed_gear(type, axis, placement);
    data.period = mesh->pitch();
    data.mesh = mesh;
  } else {
    const auto mesh = placed_rack(axis, placement);
    data.period = mesh->turn();
    data.mesh = mesh;
  }
  const double cosine = std::cos(transverse_angle(placement.pressure_angle, placement.helix_angle));
  if (!(backlash * cosine < kMostPlay * data.period)) {
    throw ModelError(
        fmt::format("its `backlash` of {:g} m is more than a space between teeth, {:g} m; correct "
                    "it, or {}",
                    backlash, kMostPlay * data.period / cosine,
                    type == JointType::gear ? "`teeth`" : "`radius`"));
  }
  data.play = backlash * cosine;
  data.side = 1.0;
  const auto driving = std::make_shared<FlankGap>(data);
  data.side = -1.0;
  const auto other = std::make_shared<FlankGap>(data);
  return {{JointCoordinate::measured(driving), JointCoordinate::measured(other)},
          data.play,
          data.period};
}

}  // namespace buckens::joints
