// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_belt.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/elastic_belt.h"

namespace buckens::model {

using Eigen::Vector3d;

void set_belt(const loads::ElasticBeltSpec& spec, MarkerFinder& find, Load& load,
              const SourceLocation& where) {
  const std::string what = fmt::format("load \"{}\"", load.name);
  load.first = find.marker(spec.between[0], true);
  load.second = find.marker(spec.between[1], true);
  find.require_two_bodies(load.first, load.second, what, where);
  find.require_moment(load.first, what, where);
  find.require_moment(load.second, what, where);
  joints::Placement p = find.placement(load.first, load.second);
  p.axis_F = find.axis_or_normal(spec.axis, p.R_WF, what, where);
  loads::ElasticBeltData data;
  data.axis_F = joints::unit_axis(p);
  const Vector3d axis_W = p.R_WF * data.axis_F;
  find.require_across_plane(axis_W, "a belt", what, where);
  data.first_radius = spec.radii[0];
  data.second_radius = spec.crossed ? -spec.radii[1] : spec.radii[1];
  const Vector3d apart = find.placed(load.second).p - find.placed(load.first).p;
  const double distance = (apart - axis_W * axis_W.dot(apart)).norm();
  const double least = std::abs(data.first_radius - data.second_radius);
  if (!(distance > least)) {
    throw InputError(
        where, fmt::format("{}: the centres of its pulleys are {:g} m apart across the axis, which "
                           "leaves no room for {}; more than {:g} m is needed",
                           what, distance, spec.crossed ? "a crossed belt" : "its spans", least));
  }
  const Vector3d x_W = axis_W.unitOrthogonal();
  data.x_F = p.R_WF.transpose() * x_W;
  data.x_M = p.R_WM.transpose() * x_W;
  const Vector3d e = (apart - axis_W * axis_W.dot(apart)) / distance;
  data.placed_angle = std::atan2(axis_W.dot(e.cross(x_W)), e.dot(x_W));
  data.way = loads::ElasticBelt::way(distance, data.first_radius, data.second_radius);
  const double span = std::sqrt(distance * distance - least * least);
  data.stiffness = spec.stiffness / span;
  data.damping = data.stiffness * spec.damping_time;
  data.pretension = spec.pretension;
  data.coefficient = spec.coefficient;
  load.element = std::make_unique<loads::ElasticBelt>(data);
}

}  // namespace buckens::model
