// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/ring_near_line.h"

#include <algorithm>
#include <cmath>

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

constexpr int kMostHalvings = 80;
// Square of the sine between line and axis below which there are no two sides.
constexpr double kRatherAlong = 0.1;
// Sine between both below which any diameter is across.
constexpr double kAlongAxis = 1e-12;

/// Half the derivative of the squared distance over the angle from the long axis of the ellipse,
/// −A sin cos + p sin − t cos, in the quarter in which its sign changes from − to +.
struct Quarter {
  double A, p, t;

  /// Whether a place is nearest there.
  bool has_nearest() const { return t > 0.0 || power(p) + power(t) < power(A); }
  double root() const {
    double low = t > 0.0 ? 0.0 : std::atan2(std::cbrt(-t), std::cbrt(p)), high = 0.5 * M_PI;
    double angle = p < A ? std::acos(p / A) : std::atan2(t, p - A);
    angle = std::clamp(angle, low, high);
    for (int k = 0; k < kMostHalvings; ++k) {
      const double s = std::sin(angle), c = std::cos(angle);
      const double slope = (p - A * c) * s - t * c;
      if (slope == 0.0) break;
      (slope < 0.0 ? low : high) = angle;
      const double curve = A * (s - c) * (s + c) + p * c + t * s;
      double next = angle - slope / curve;
      if (!(curve > 0.0) || next < low || next > high) next = 0.5 * (low + high);
      const bool is_found = next == angle || high - low <= 1e-16 * high;
      angle = next;
      if (is_found) break;
    }
    return angle;
  }

 private:
  static double power(double x) { return std::cbrt(x * x); }
};

}  // namespace

Vector3d towards_line(const Vector3d& axis, double radius, const Vector3d& r, const Vector3d& along,
                      double towards) {
  const double beta = axis.dot(along);
  Vector3d w = along - beta * axis;
  const double sine = w.norm();
  w = sine > kAlongAxis ? Vector3d(w / sine) : axis.unitOrthogonal();
  const Vector3d u = w.cross(axis);
  const double beside = u.dot(r);
  const double off = beta * (sine * axis - beta * w).dot(r);
  double side = sine * sine < kRatherAlong ? (off > 0.0 ? -1.0 : 1.0) : towards;
  Quarter quarter{radius * sine * sine, std::abs(beside), -side * off};
  if (!quarter.has_nearest() && quarter.t < 0.0) {
    side = -side;
    quarter.t = -quarter.t;
  }
  const double angle = quarter.root();
  return (beside < 0.0 ? -1.0 : 1.0) * std::cos(angle) * u + side * std::sin(angle) * w;
}

}  // namespace buckens::spatial
