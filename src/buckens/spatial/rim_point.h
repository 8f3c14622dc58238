// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "buckens/spatial/rim_touch.h"

namespace buckens::spatial {

// By this much a normal may lie outside of what an edge or rim admits: overlaps, and rounding where
// ends lie on faces.
inline constexpr double kOutOfCone = 1e-4;
// Sine between tangents that have no direction across both, and below which it says little.
inline constexpr double kAlongRim = 1e-9, kAlmostAlongRim = 0.05;
// Share of the radius up to which points that are apart keep the direction across both.
inline constexpr double kAtRim = 1e-4;

/// A point of a rim in space, which moves with its body.
struct RimPoint {
  const MarkerMotion& owner;
  double radius;
  Eigen::Vector3d centre, axis;
  Eigen::Vector3d radial = Eigen::Vector3d::Zero(), tangent = Eigen::Vector3d::Zero();

  RimPoint(const Rim& rim, const MarkerMotion& motion)
      : owner(motion),
        radius(rim.radius),
        centre(motion.p + motion.R * rim.middle),
        axis(motion.R * rim.axis) {}

  /// @param unit from the middle to the point
  void turn_to(const Eigen::Vector3d& unit) {
    radial = unit;
    tangent = axis.cross(radial);
  }
  /// Direction of the rim's place next to a point.
  Eigen::Vector3d nearest_to(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d from = x - centre, within = from - axis.dot(from) * axis;
    const double size = within.norm();
    return size > 0.0 ? Eigen::Vector3d(within / size) : axis.unitOrthogonal();
  }
  Eigen::Vector3d place() const { return centre + radius * radial; }
  Eigen::Vector3d rate() const { return owner.v + owner.w.cross(place() - owner.p); }
  Eigen::Vector3d centre_rate() const { return owner.v + owner.w.cross(centre - owner.p); }
  /// Rate of the tangent while the point stays on the body.
  Eigen::Vector3d turning() const { return owner.w.cross(tangent); }
  /// Whether a normal that leads here from another body is one of the rim.
  bool sees(const Eigen::Vector3d& normal) const {
    return normal.dot(axis) <= kOutOfCone && normal.dot(radial) <= kOutOfCone;
  }
  /// A rate along the rim; where it touches in passing, none.
  double share(double rate_of_slope, double slope) const {
    return std::abs(slope) > kAlongRim * radius ? rate_of_slope / slope : 0.0;
  }
};

/// The direction across two tangents.
struct Crossing {
  Eigen::Vector3d normal, rate;
  double sine;

  Crossing(const Eigen::Vector3d& one, const Eigen::Vector3d& one_rate,
           const Eigen::Vector3d& other, const Eigen::Vector3d& other_rate)
      : normal(one.cross(other)),
        rate(one_rate.cross(other) + one.cross(other_rate)),
        sine(normal.norm()) {}
  /// Makes it a unit vector. @param out out of the first body and into the second, about
  /// @return false: there is none
  bool lead(const Eigen::Vector3d& out) {
    if (sine < kAlongRim) return false;
    const double scale = (normal.dot(out) < 0.0 ? -1.0 : 1.0) / sine;
    normal *= scale;
    rate *= scale;
    rate -= normal.dot(rate) * normal;
    return true;
  }
  /// @param leads_out of both bodies: overlaps count
  /// @return false: the points are apart in any case, and know better
  bool set(const MovingPoint& first, const MovingPoint& second, bool leads_out, double radius,
           TouchPlace& out) const {
    const Eigen::Vector3d d = second.x - first.x;
    out.gap = normal.dot(d);
    if (!leads_out || sine < kAlmostAlongRim) {
      if (d.norm() > kAtRim * radius) return false;
      out.gap = std::abs(out.gap);
    }
    out.normal = normal;
    out.normal_rate = rate;
    out.place = 0.5 * (first.x + second.x);
    out.place_rate = 0.5 * (first.rate + second.rate);
    return true;
  }
};

}  // namespace buckens::spatial
