// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_cam.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/joints/curve_gap.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/model/build/curve_of_path.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

std::shared_ptr<const joints::CurveGap> gap_of(const loads::CamSpec& spec, const Vector3d& normal) {
  const auto curve = curve_of_path(spec);
  joints::CurveGap::Data data;
  data.normal_F = normal;
  data.radius = spec.roller;
  data.is_on_left = spec.side ? *spec.side == loads::CurveSide::left
                              : !spec.closed || !joints::CurveGap::encloses_left(*curve, normal);
  return std::make_shared<joints::CurveGap>(curve, data);
}

}  // namespace

void set_cam(const loads::CamSpec& spec, MarkerFinder& find, Load& load,
             const SourceLocation& where) {
  const std::string what = fmt::format("load \"{}\"", load.name);
  load.first = find.marker(spec.between[0], true);
  load.second = find.marker(spec.between[1], true);
  find.require_two_bodies(load.first, load.second, what, where);
  find.require_moment(load.first, what, where);
  const joints::Placement p = find.placement(load.first, load.second);
  const Vector3d normal = find.axis_or_normal(spec.normal, p.R_WF, what, where);
  find.require_across_plane((p.R_WF * normal).normalized(), "a cam", what, where);
  try {
    load.coordinate = static_cast<int>(find.model().coordinates.size());
    find.model().coordinates.push_back(
        {-1, load.first, load.second, joints::JointCoordinate::gap(gap_of(spec, normal))});
  } catch (const ModelError& error) {
    throw ModelError(where, fmt::format("{}: {}", what, error.what()));
  }
  if (spec.stiffness) {
    load.element =
        std::make_unique<loads::CoordinateStop>(0.0, HUGE_VAL, *spec.stiffness, spec.damping);
    return;
  }
  const double length = find.model().length;
  load.element = std::make_unique<loads::RigidStop>(
      0.0, HUGE_VAL, spec.restitution.value_or(0.0),
      spec.threshold.value_or(loads::RigidStop::kAtRest * length));
}

}  // namespace buckens::model
