// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rotation.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/principal_axes.h"

namespace buckens::spatial {

namespace {

// Principal moments up to this share of the largest are rounding.
constexpr double kNoInertia = 1e-14;

// Cosines below this are of directions whose product is mostly rounding.
constexpr double kNearlyOpposite = -1.0 + 1e-12;

// What is left of a unit vector beside its opposite is rounding up to this.
constexpr double kRoundingAside = 1e-15;

/// Unit vector across two unit vectors that are nearly opposite: the last column of Q in the QR
/// decomposition of both, by Householder's reflections.
Eigen::Vector3d axis_across(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  // The first reflection takes `first` to the x axis.
  const double image = first.x() < 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d mirror(1.0, first.y() / (first.x() - image),
                               first.z() / (first.x() - image));
  const double twice = (image - first.x()) / image;
  const auto reflected = [&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x - twice * mirror.dot(x) * mirror);
  };
  // The second one takes what is left of `second` to the y axis.
  const Eigen::Vector3d rest = reflected(second);
  const double length = std::hypot(rest.y(), rest.z());
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  if (length > kRoundingAside) axis = Eigen::Vector3d(0.0, -rest.z(), rest.y()) / length;
  axis = reflected(axis);
  // Of the two turns by less than a half, the one that goes there.
  return axis.dot(first.cross(second)) < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

}  // namespace

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

// As Quaterniond::FromTwoVectors, whose singular values of a matrix take six seconds to compile.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond q;
  if (cosine < kNearlyOpposite) {
    const double square = 0.5 * (1.0 + std::max(cosine, -1.0));
    q.w() = std::sqrt(square);
    q.vec() = axis_across(a, b) * std::sqrt(1.0 - square);
    return q;
  }
  const double twice = std::sqrt(2.0 * (1.0 + cosine));
  q.vec() = a.cross(b) * (1.0 / twice);
  q.w() = 0.5 * twice;
  return q;
}

Eigen::Vector3d spin_of(const Eigen::Matrix3d& J, const Eigen::Vector3d& L) {
  const PrincipalAxes principal = principal_axes(J);
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!(principal.values[k] > kNoInertia * principal.values[2])) continue;
    const Eigen::Vector3d axis = principal.vectors.col(k);
    w += axis.dot(L) / principal.values[k] * axis;
  }
  return w;
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
