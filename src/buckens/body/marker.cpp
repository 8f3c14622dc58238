// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/marker.h"

#include "buckens/spatial/rotation.h"

namespace buckens::body {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Rᵀ v, written out: Eigen calls a function for it, and there are many of these.
Vector3d turned_back(const Matrix3d& R, const Vector3d& v) {
  return {R.col(0).dot(v), R.col(1).dot(v), R.col(2).dot(v)};
}

Vector3d rows(const VectorXd& y, int first) {
  return first < 0 ? Vector3d::Zero() : Vector3d(y.segment<3>(first));
}

}  // namespace

Eigen::Matrix<double, 6, 1> MarkerKinematics::frame_load(const spatial::Wrench& wrench) const {
  Eigen::Matrix<double, 6, 1> load;
  load.head<3>() = turned_back(R_WB, wrench.torque) + z.cross(turned_back(R_WB, wrench.force));
  load.tail<3>() = wrench.force;
  return load;
}

Eigen::Matrix<double, 6, 1> MarkerKinematics::interface_load(const spatial::Wrench& wrench) const {
  Eigen::Matrix<double, 6, 1> load;
  load.head<3>() = turned_back(R_WB, wrench.force);
  load.tail<3>() = turned_back(rotation_map, turned_back(R_WB, wrench.torque));
  return load;
}

MarkerKinematics marker_kinematics(const Marker& marker, const FrameMotion& frame,
                                   const VectorXd& y, const VectorXd& y_dot) {
  MarkerKinematics out;
  out.R_WB = frame.X_WB.R();
  out.z = marker.X_BF.p + rows(y, marker.translation_row);
  const Vector3d z_dot = rows(y_dot, marker.translation_row);
  Matrix3d R_BF = marker.X_BF.R();
  Vector3d w_relative = Vector3d::Zero();
  out.rotation_map.setIdentity();
  if (marker.rotation_row >= 0) {
    const Vector3d theta = rows(y, marker.rotation_row);
    out.rotation_map = spatial::left_jacobian(theta);
    w_relative = out.rotation_map * rows(y_dot, marker.rotation_row);
    R_BF = spatial::exp_rotation(theta).toRotationMatrix() * R_BF;
  }
  out.motion.p = frame.X_WB.p + out.R_WB * out.z;
  out.motion.R = out.R_WB * R_BF;
  out.motion.w = out.R_WB * (frame.w + w_relative);
  out.motion.v = frame.v + out.R_WB * (frame.w.cross(out.z) + z_dot);
  return out;
}

spatial::MarkerBias marker_bias(const Marker& marker, const FrameMotion& frame, const VectorXd& y,
                                const VectorXd& y_dot) {
  const Matrix3d R = frame.X_WB.R();
  const Vector3d& w = frame.w;
  const Vector3d z = marker.X_BF.p + rows(y, marker.translation_row);
  const Vector3d z_dot = rows(y_dot, marker.translation_row);
  spatial::MarkerBias bias;
  bias.a = R * (w.cross(w.cross(z)) + 2.0 * w.cross(z_dot));
  if (marker.rotation_row >= 0) {
    const Vector3d theta = rows(y, marker.rotation_row);
    const Vector3d theta_dot = rows(y_dot, marker.rotation_row);
    const Vector3d w_relative = spatial::left_jacobian(theta) * theta_dot;
    bias.alpha = R * (w.cross(w_relative) + spatial::left_jacobian_rate(theta, theta_dot));
  }
  return bias;
}

}  // namespace buckens::body
