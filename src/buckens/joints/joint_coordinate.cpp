// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/joint_coordinate.h"

#include <cmath>
#include <utility>

#include "buckens/joints/gap_law.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerMotion;

namespace {
/// R v, written out: Eigen calls a function for it, and friction needs many.
inline Vector3d axes_times(const Eigen::Matrix3d& R, const Vector3d& v) {
  return R.col(0) * v[0] + R.col(1) * v[1] + R.col(2) * v[2];
}
}  // namespace

JointCoordinate JointCoordinate::angle(const Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed) {
  return first_angle(axis_F, axis_F.unitOrthogonal(), R_FM_placed);
}

JointCoordinate JointCoordinate::first_angle(const Vector3d& arm_F, const Vector3d& other_F,
                                             const Eigen::Matrix3d& R_FM_placed) {
  JointCoordinate out;
  out.kind_ = Kind::angle;
  out.is_angle_ = true;
  out.turn_ = kTurn;
  out.axis_F_ = arm_F;
  out.x_F_ = other_F;
  out.x_M_ = R_FM_placed.transpose() * other_F;
  return out;
}

JointCoordinate JointCoordinate::second_angle(const Vector3d& arm_F, const Vector3d& other_F,
                                              const Eigen::Matrix3d& R_FM_placed) {
  JointCoordinate out;
  out.kind_ = Kind::second_angle;
  out.is_angle_ = true;
  out.turn_ = kTurn;
  out.axis_F_ = other_F;
  out.axis_M_ = R_FM_placed.transpose() * other_F;
  out.x_F_ = arm_F;
  out.x_M_ = R_FM_placed.transpose() * arm_F;
  return out;
}

JointCoordinate JointCoordinate::displacement(const Vector3d& axis_F, const Vector3d& r_F_placed) {
  JointCoordinate out;
  out.kind_ = Kind::displacement;
  out.axis_F_ = axis_F;
  out.offset_ = axis_F.dot(r_F_placed);
  return out;
}

JointCoordinate JointCoordinate::length() {
  JointCoordinate out;
  out.kind_ = Kind::length;
  return out;
}

JointCoordinate JointCoordinate::gap(std::shared_ptr<const GapLaw> law) {
  JointCoordinate out;
  out.kind_ = Kind::gap;
  out.gap_ = std::move(law);
  return out;
}

JointCoordinate JointCoordinate::measured(std::shared_ptr<const CoordinateMeasure> measure) {
  JointCoordinate out;
  out.kind_ = Kind::measured;
  out.is_angle_ = measure->is_angle();
  out.turn_ = measure->turn();
  out.axis_F_.setZero();
  out.measure_ = std::move(measure);
  return out;
}

namespace {
/// Direction from F to M; any where they coincide.
Vector3d line_of(const MarkerMotion& F, const MarkerMotion& M) {
  const Vector3d r = M.p - F.p;
  const double length = r.norm();
  return length > 0.0 ? Vector3d(r / length) : Vector3d::UnitX();
}
}  // namespace

double JointCoordinate::fraction(const MarkerMotion& F, const MarkerMotion& M,
                                 const CountedValue* before) const {
  if (kind_ == Kind::measured) return measure_->look(F, M, before).fraction;
  if (kind_ == Kind::length) return (M.p - F.p).norm();
  if (kind_ == Kind::gap) return gap_->gap(F, M);
  const Vector3d axis =
      kind_ == Kind::second_angle ? axes_times(M.R, axis_M_) : axes_times(F.R, axis_F_);
  if (kind_ == Kind::displacement) return axis.dot(M.p - F.p) - offset_;
  const Vector3d x = axes_times(F.R, x_F_);
  const Vector3d moved = axes_times(M.R, x_M_);
  return std::atan2(axis.cross(x).dot(moved), x.dot(moved));
}

spatial::PairRow JointCoordinate::derivatives(const MarkerMotion& F, const MarkerMotion& M,
                                              const CountedValue* before) const {
  if (kind_ == Kind::measured) return measure_->look(F, M, before).J;
  spatial::PairRow J = spatial::PairRow::Zero();
  if (kind_ == Kind::length) {
    const Vector3d n = line_of(F, M);
    J.segment<3>(3) = -n.transpose();
    J.segment<3>(9) = n.transpose();
    return J;
  }
  if (kind_ == Kind::gap) return gap_->derivatives(F, M);
  const Vector3d axis =
      kind_ == Kind::second_angle ? axes_times(M.R, axis_M_) : axes_times(F.R, axis_F_);
  if (is_angle()) {
    J.segment<3>(0) = -axis.transpose();
    J.segment<3>(6) = axis.transpose();
    return J;
  }
  J.segment<3>(0) = axis.cross(M.p - F.p).transpose();
  J.segment<3>(3) = -axis.transpose();
  J.segment<3>(9) = axis.transpose();
  return J;
}

CoordinateLook JointCoordinate::look(const MarkerMotion& F, const MarkerMotion& M,
                                     const CountedValue* before) const {
  CoordinateLook out;
  if (kind_ > Kind::second_angle) {  // one question for what has an axis, of which there is most
    if (kind_ == Kind::measured) return measure_->look(F, M, before);
    out.fraction = fraction(F, M);
    out.J = derivatives(F, M);
    out.take_rate(F, M);
    return out;
  }
  const Vector3d axis =
      kind_ == Kind::second_angle ? axes_times(M.R, axis_M_) : axes_times(F.R, axis_F_);
  if (is_angle()) {
    const Vector3d x = axes_times(F.R, x_F_);
    const Vector3d moved = axes_times(M.R, x_M_);
    out.fraction = std::atan2(axis.cross(x).dot(moved), x.dot(moved));
    out.rate = axis.dot(M.w) - axis.dot(F.w);
    out.J.segment<3>(0) = -axis.transpose();
    out.J.segment<3>(6) = axis.transpose();
    return out;
  }
  const Vector3d r = M.p - F.p;
  const Vector3d lever = axis.cross(r);
  out.fraction = axis.dot(r) - offset_;
  out.rate = lever.dot(F.w) - axis.dot(F.v) + axis.dot(M.v);
  out.J.segment<3>(0) = lever.transpose();
  out.J.segment<3>(3) = -axis.transpose();
  out.J.segment<3>(9) = axis.transpose();
  return out;
}

double JointCoordinate::bias(const MarkerMotion& F, const MarkerMotion& M,
                             const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
                             const CountedValue* before) const {
  if (kind_ == Kind::measured) return measure_->bias(F, M, bias_F, bias_M, before);
  if (kind_ == Kind::length) {
    const Vector3d n = line_of(F, M);
    const Vector3d r_dot = M.v - F.v;
    const double length = (M.p - F.p).norm();
    const double across = r_dot.squaredNorm() - n.dot(r_dot) * n.dot(r_dot);
    return n.dot(bias_M.a - bias_F.a) + (length > 0.0 ? across / length : 0.0);
  }
  if (kind_ == Kind::gap) return gap_->bias(F, M, bias_F, bias_M);
  const Vector3d axis = axis_now(F, M);
  const Vector3d axis_rate = (kind_ == Kind::second_angle ? M.w : F.w).cross(axis);
  if (is_angle()) {
    return axis.dot(bias_M.alpha - bias_F.alpha) + axis_rate.dot(M.w - F.w);
  }
  const Vector3d axis_bias = bias_F.alpha.cross(axis) + F.w.cross(axis_rate);
  return axis_bias.dot(M.p - F.p) + 2.0 * axis_rate.dot(M.v - F.v) + axis.dot(bias_M.a - bias_F.a);
}

}  // namespace buckens::joints
