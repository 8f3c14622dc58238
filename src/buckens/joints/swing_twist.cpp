// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/swing_twist.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/rotation.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

// Sine below which a swing has no direction but rounding, and the same for 1 + cos φ of a twist.
constexpr double kNoSwing = 1e-12;

spatial::PairRow about(const Vector3d& axis) {
  spatial::PairRow out = spatial::PairRow::Zero();
  out.segment<3>(0) = -axis.transpose();
  out.segment<3>(6) = axis.transpose();
  return out;
}

/// Axis u about which two axes swing apart.
Vector3d swing_axis(const Vector3d& a, const Vector3d& b, const Vector3d& turning) {
  const Vector3d across = a.cross(b);
  const double sine = across.norm();
  if (sine > kNoSwing) return across / sine;
  const Vector3d parting = turning - a.dot(turning) * a;
  const double speed = parting.norm();
  if (!(speed > 0.0)) return a.unitOrthogonal();
  return (a.dot(b) > 0.0 ? 1.0 : -1.0) / speed * parting;
}

}  // namespace

CoordinateLook Swing::look(const MarkerMotion& F, const MarkerMotion& M,
                           const CountedValue* /*before*/) const {
  const Vector3d a = F.R * axis_F_;
  const Vector3d b = M.R * axis_M_;
  CoordinateLook out;
  out.fraction = std::atan2(a.cross(b).norm(), a.dot(b));
  const Vector3d u = swing_axis(a, b, M.w - F.w);
  out.J = about(u);
  out.rate = u.dot(M.w - F.w);
  return out;
}

double Swing::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                   const MarkerBias& bias_M, const CountedValue* /*before*/) const {
  const Vector3d a = F.R * axis_F_;
  const Vector3d b = M.R * axis_M_;
  const Vector3d turning = M.w - F.w;
  const Vector3d u = swing_axis(a, b, turning);
  const double own = u.dot(bias_M.alpha - bias_F.alpha);
  const Vector3d across = a.cross(b);
  const double sine = across.norm();
  if (sine <= kNoSwing) return own;
  const Vector3d across_rate = F.w.cross(a).cross(b) + a.cross(M.w.cross(b));
  return own + (across_rate - u.dot(across_rate) * u).dot(turning) / sine;
}

Twist::Twist(const Vector3d& axis_F, const Vector3d& other_F, const Eigen::Matrix3d& R_FM_placed)
    : axis_F_(axis_F), x_F_(axis_F.unitOrthogonal()), y_F_(axis_F.cross(x_F_)) {
  const Eigen::Matrix3d swung = spatial::rotation_between(axis_F, other_F).toRotationMatrix();
  axis_M_ = R_FM_placed.transpose() * other_F;
  x_M_ = R_FM_placed.transpose() * (swung * x_F_);
  y_M_ = R_FM_placed.transpose() * (swung * y_F_);
}

CoordinateLook Twist::look(const MarkerMotion& F, const MarkerMotion& M,
                           const CountedValue* /*before*/) const {
  const Vector3d x = F.R * x_F_, y = F.R * y_F_;
  const Vector3d moved_x = M.R * x_M_, moved_y = M.R * y_M_;
  const Vector3d a = F.R * axis_F_, b = M.R * axis_M_;
  CoordinateLook out;
  out.fraction = std::atan2(y.dot(moved_x) - x.dot(moved_y), x.dot(moved_x) + y.dot(moved_y));
  const Vector3d n = (a + b) / std::max(1.0 + a.dot(b), kNoSwing);
  out.J = about(n);
  out.rate = n.dot(M.w - F.w);
  return out;
}

double Twist::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                   const MarkerBias& bias_M, const CountedValue* /*before*/) const {
  const Vector3d a = F.R * axis_F_, b = M.R * axis_M_;
  const Vector3d turning = M.w - F.w;
  const double open = std::max(1.0 + a.dot(b), kNoSwing);
  const Vector3d n = (a + b) / open;
  const double open_rate = -a.cross(b).dot(turning);
  const Vector3d n_rate = (F.w.cross(a) + M.w.cross(b) - open_rate * n) / open;
  return n.dot(bias_M.alpha - bias_F.alpha) + n_rate.dot(turning);
}

}  // namespace buckens::joints
