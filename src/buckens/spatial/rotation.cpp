// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rotation.h"

#include <cmath>

namespace buckens::spatial {

Eigen::Matrix3d skew(const Eigen::Vector3d& x) {
  Eigen::Matrix3d s;
  s << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
  return s;
}

Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& psi) {
  const double angle = psi.norm();
  // sin(a/2)/a by its series where the quotient would lose digits.
  const double s = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q(std::cos(0.5 * angle), s * psi.x(), s * psi.y(), s * psi.z());
  q.normalize();
  return q;
}

// Both make decompositions of small matrices, which take seconds to compile: once, here.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Eigen::Vector3d spin_of(const Eigen::Matrix3d& J, const Eigen::Vector3d& L) {
  return J.completeOrthogonalDecomposition().solve(L);
}

Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q_in) {
  Eigen::Quaterniond q = q_in.normalized();
  if (q.w() < 0) q.coeffs() *= -1.0;
  const double s = q.vec().norm();
  if (s < 1e-12) return 2.0 * q.vec();
  return (2.0 * std::atan2(s, q.w()) / s) * q.vec();
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& theta) {
  const double a = theta.norm();
  double b = 0.5 - a * a / 24.0;
  double c = 1.0 / 6.0 - a * a / 120.0;
  if (a > 1e-3) {
    b = (1.0 - std::cos(a)) / (a * a);
    c = (a - std::sin(a)) / (a * a * a);
  }
  const Eigen::Matrix3d s = skew(theta);
  return Eigen::Matrix3d::Identity() + b * s + c * s * s;
}

Eigen::Vector3d left_jacobian_rate(const Eigen::Vector3d& theta, const Eigen::Vector3d& theta_dot) {
  const double rate = theta_dot.norm();
  if (rate == 0.0) return Eigen::Vector3d::Zero();
  const double tau = 1e-5 / rate;  // a rotation of 1e-5 rad each way
  const Eigen::Matrix3d difference =
      left_jacobian(theta + tau * theta_dot) - left_jacobian(theta - tau * theta_dot);
  return difference * theta_dot / (2.0 * tau);
}

}  // namespace buckens::spatial
