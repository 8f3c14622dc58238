// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/spring_damper.h"

#include <cmath>
#include <utility>

#include "buckens/base/errors.h"
#include "buckens/loads/curve_slopes.h"

namespace buckens::loads {

using Eigen::Vector3d;
using spatial::MarkerMotion;

SpringDamper::SpringDamper(base::SignalLaw stiffness, base::SignalLaw damping,
                           base::SignalLaw free_length, std::optional<base::SignalLaw> tension,
                           std::optional<base::Characteristic> curve)
    : laws_(std::move(stiffness), std::move(damping), std::move(free_length)),
      tension_(std::move(tension)),
      curve_(std::move(curve)) {}

Action SpringDamper::evaluate(double t, const MarkerMotion& first,
                              const MarkerMotion& second) const {
  return respond({t, first, second});
}

Action SpringDamper::respond(const Sight& sight) const {
  const auto [stiffness, damping, free] = laws_.at(sight.t, sight.signals);
  Action action;
  const Vector3d r = sight.second.p - sight.first.p;
  const double length = r.norm();
  const double stretch = length - free;
  action.stored_energy = 0.5 * stiffness * stretch * stretch;
  const double law = tension_ ? tension_->value(sight.t, sight.signals) : 0.0;
  const double at_rest = curve_ ? curve_->force(stretch, 0.0) : 0.0;
  if (curve_) action.stored_energy += curve_->energy(stretch);
  if (length == 0.0) {
    if (stiffness * free == 0.0 && law == 0.0 && at_rest == 0.0) return action;
    throw NumericalError(
        "a spring-damper has no direction: its two markers coincide; "
        "place them apart or use a bushing");
  }
  const Vector3d n = r / length;
  const double length_rate = n.dot(sight.second.v - sight.first.v);
  double lost = damping * length_rate;
  if (curve_) lost += curve_->force(stretch, length_rate) - at_rest;
  const double active = lost + law;
  const double tension = stiffness * stretch + at_rest + active;
  action.on_first.force = tension * n;
  action.on_second.force = -tension * n;
  action.active_power = -active * length_rate;
  action.dissipation = lost * length_rate;
  return action;
}

void SpringDamper::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const auto [stiffness, damping, free] = laws_.at(sight.t, sight.signals);
  SoftRow row;
  const Vector3d r = sight.second.p - sight.first.p;
  const double length = r.norm();
  if (length > 0.0) {
    row.J.segment<3>(3) = -r.transpose() / length;
    row.J.segment<3>(9) = r.transpose() / length;
  }
  row.stiffness = stiffness;
  row.damping = damping;
  if (length > 0.0) {
    add_slopes(curve_, length - free, r.dot(sight.second.v - sight.first.v) / length, row);
  }
  rows.push_back(row);
}

TorsionalSpring::TorsionalSpring(const Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed,
                                 base::SignalLaw stiffness, base::SignalLaw damping,
                                 base::SignalLaw free_angle,
                                 std::optional<base::Characteristic> curve)
    : axis_F_(axis_F.normalized()),
      laws_(std::move(stiffness), std::move(damping), std::move(free_angle)),
      curve_(std::move(curve)) {
  x_F_ = axis_F_.unitOrthogonal();
  x_M_ = R_FM_placed.transpose() * x_F_;
}

TorsionalSpring::Twist TorsionalSpring::twist(const MarkerMotion& first,
                                              const MarkerMotion& second) const {
  const Vector3d axis = first.R * axis_F_;
  const Vector3d x = first.R * x_F_;
  const Vector3d moved = second.R * x_M_;
  const double angle = std::atan2(axis.cross(x).dot(moved), x.dot(moved));
  if (std::abs(angle) > kLargestAngle) {
    throw NumericalError("a torsional spring is twisted by " + std::to_string(angle) +
                         " rad, more than the 3 rad it can measure; limit the motion");
  }
  return {angle, axis.dot(second.w - first.w)};
}

Action TorsionalSpring::evaluate(double t, const MarkerMotion& first,
                                 const MarkerMotion& second) const {
  return respond({t, first, second});
}

Action TorsionalSpring::respond(const Sight& sight) const {
  const auto [stiffness, damping, free] = laws_.at(sight.t, sight.signals);
  const Vector3d axis = sight.first.R * axis_F_;
  const auto [placed, rate] = twist(sight.first, sight.second);
  const double angle = placed - free;
  const double at_rest = curve_ ? curve_->force(angle, 0.0) : 0.0;
  double lost = damping * rate;
  if (curve_) lost += curve_->force(angle, rate) - at_rest;
  const double torque = stiffness * angle + at_rest + lost;
  Action action;
  action.on_first.torque = torque * axis;
  action.on_second.torque = -torque * axis;
  action.stored_energy = 0.5 * stiffness * angle * angle;
  if (curve_) action.stored_energy += curve_->energy(angle);
  action.active_power = -lost * rate;
  action.dissipation = lost * rate;
  return action;
}

void TorsionalSpring::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const auto [stiffness, damping, free] = laws_.at(sight.t, sight.signals);
  const Vector3d axis = sight.first.R * axis_F_;
  SoftRow row;
  row.J.segment<3>(0) = -axis.transpose();
  row.J.segment<3>(6) = axis.transpose();
  row.stiffness = stiffness;
  row.damping = damping;
  if (curve_) {
    const auto [angle, rate] = twist(sight.first, sight.second);
    add_slopes(curve_, angle - free, rate, row);
  }
  rows.push_back(row);
}

}  // namespace buckens::loads
