// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/joint_coordinate.h"

#include <cmath>
#include <numbers>

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerMotion;

namespace {
constexpr double kTurn = 2.0 * std::numbers::pi;
}  // namespace

double CountedValue::value() const { return kTurn * turns + fraction; }

double difference(const CountedValue& from, const CountedValue& to) {
  return kTurn * (to.turns - from.turns) + (to.fraction - from.fraction);
}

JointCoordinate JointCoordinate::angle(const Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed) {
  JointCoordinate out;
  out.kind_ = Kind::angle;
  out.axis_F_ = axis_F;
  out.x_F_ = axis_F.unitOrthogonal();
  out.x_M_ = R_FM_placed.transpose() * out.x_F_;
  return out;
}

JointCoordinate JointCoordinate::displacement(const Vector3d& axis_F, const Vector3d& r_F_placed) {
  JointCoordinate out;
  out.kind_ = Kind::displacement;
  out.axis_F_ = axis_F;
  out.offset_ = axis_F.dot(r_F_placed);
  return out;
}

double JointCoordinate::fraction(const MarkerMotion& F, const MarkerMotion& M) const {
  const Vector3d axis = F.R * axis_F_;
  if (kind_ == Kind::displacement) return axis.dot(M.p - F.p) - offset_;
  const Vector3d x = F.R * x_F_;
  const Vector3d moved = M.R * x_M_;
  return std::atan2(axis.cross(x).dot(moved), x.dot(moved));
}

spatial::PairRow JointCoordinate::derivatives(const MarkerMotion& F, const MarkerMotion& M) const {
  spatial::PairRow J = spatial::PairRow::Zero();
  const Vector3d axis = F.R * axis_F_;
  if (kind_ == Kind::angle) {
    J.segment<3>(0) = -axis.transpose();
    J.segment<3>(6) = axis.transpose();
    return J;
  }
  J.segment<3>(0) = axis.cross(M.p - F.p).transpose();
  J.segment<3>(3) = -axis.transpose();
  J.segment<3>(9) = axis.transpose();
  return J;
}

CountedValue JointCoordinate::follow(const CountedValue& before, double fraction) const {
  CountedValue out{before.turns, fraction};
  if (kind_ == Kind::displacement) return out;
  const double jump = fraction - before.fraction;
  if (jump > 0.5 * kTurn) --out.turns;
  if (jump < -0.5 * kTurn) ++out.turns;
  return out;
}

}  // namespace buckens::joints
