// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/frame_equation.h"

#include "buckens/spatial/rotation.h"

namespace buckens::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;

body::DeformedMoments undeformed_moments(const body::Body& body) {
  body::DeformedMoments moments;
  moments.J = body.J0;
  return moments;
}

Eigen::Matrix<double, 6, 1> frame_inertia(const body::Body& body,
                                          const body::DeformedMoments& moments, const Vector3d& w,
                                          const Vector3d& w_dot, const Vector3d& v_dot) {
  Eigen::Matrix<double, 6, 1> out;
  out.head<3>() =
      moments.J * w_dot + moments.l_dot + moments.J_dot * w + w.cross(moments.J * w + moments.l);
  out.tail<3>() = body.mass * v_dot;
  return out;
}

Matrix3d gyroscopic_tangent(const body::DeformedMoments& moments, const Vector3d& w) {
  return moments.J_dot + spatial::skew(w) * moments.J - spatial::skew(moments.J * w + moments.l);
}

}  // namespace buckens::dynamics
