// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/spring_damper.h"

#include <cmath>
#include <utility>

#include "buckens/base/errors.h"

namespace buckens::loads {

using Eigen::Vector3d;
using spatial::MarkerMotion;

SpringDamper::SpringDamper(double stiffness, double damping, double free_length,
                           std::optional<base::TimeLaw> tension)
    : stiffness_(stiffness),
      damping_(damping),
      free_length_(free_length),
      tension_(std::move(tension)) {}

Action SpringDamper::evaluate(double t, const MarkerMotion& first,
                              const MarkerMotion& second) const {
  Action action;
  const Vector3d r = second.p - first.p;
  const double length = r.norm();
  const double stretch = length - free_length_;
  action.stored_energy = 0.5 * stiffness_ * stretch * stretch;
  const double law = tension_ ? tension_->value(t) : 0.0;
  if (length == 0.0) {
    if (stiffness_ * free_length_ == 0.0 && law == 0.0) return action;
    throw NumericalError(
        "a spring-damper has no direction: its two markers coincide; "
        "place them apart or use a bushing");
  }
  const Vector3d n = r / length;
  const double length_rate = n.dot(second.v - first.v);
  const double active = damping_ * length_rate + law;
  const double tension = stiffness_ * stretch + active;
  action.on_first.force = tension * n;
  action.on_second.force = -tension * n;
  action.active_power = -active * length_rate;
  action.dissipation = damping_ * length_rate * length_rate;
  return action;
}

void SpringDamper::append_soft_rows(const MarkerMotion& first, const MarkerMotion& second,
                                    std::vector<SoftRow>& rows) const {
  SoftRow row;
  const Vector3d r = second.p - first.p;
  const double length = r.norm();
  if (length > 0.0) {
    row.J.segment<3>(3) = -r.transpose() / length;
    row.J.segment<3>(9) = r.transpose() / length;
  }
  row.stiffness = stiffness_;
  row.damping = damping_;
  rows.push_back(row);
}

TorsionalSpring::TorsionalSpring(const Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed,
                                 double stiffness, double damping, double free_angle)
    : axis_F_(axis_F.normalized()),
      stiffness_(stiffness),
      damping_(damping),
      free_angle_(free_angle) {
  x_F_ = axis_F_.unitOrthogonal();
  x_M_ = R_FM_placed.transpose() * x_F_;
}

Action TorsionalSpring::evaluate(double /*t*/, const MarkerMotion& first,
                                 const MarkerMotion& second) const {
  const Vector3d axis = first.R * axis_F_;
  const Vector3d x = first.R * x_F_;
  const Vector3d moved = second.R * x_M_;
  const double angle = std::atan2(axis.cross(x).dot(moved), x.dot(moved));
  if (std::abs(angle) > kLargestAngle) {
    throw NumericalError("a torsional spring is twisted by " + std::to_string(angle) +
                         " rad, more than the 3 rad it can measure; limit the motion");
  }
  const double rate = axis.dot(second.w - first.w);
  const double twist = angle - free_angle_;
  const double torque = stiffness_ * twist + damping_ * rate;
  Action action;
  action.on_first.torque = torque * axis;
  action.on_second.torque = -torque * axis;
  action.stored_energy = 0.5 * stiffness_ * twist * twist;
  action.active_power = -damping_ * rate * rate;
  action.dissipation = damping_ * rate * rate;
  return action;
}

void TorsionalSpring::append_soft_rows(const MarkerMotion& first, const MarkerMotion& /*second*/,
                                       std::vector<SoftRow>& rows) const {
  const Vector3d axis = first.R * axis_F_;
  SoftRow row;
  row.J.segment<3>(0) = -axis.transpose();
  row.J.segment<3>(6) = axis.transpose();
  row.stiffness = stiffness_;
  row.damping = damping_;
  rows.push_back(row);
}

}  // namespace buckens::loads
