// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "buckens/spatial/rim_point.h"
#include "buckens/spatial/rim_touch.h"

namespace buckens::spatial {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kMostTurns = 30;
constexpr int kFirstTurns = 4;
// Share of the radius by which the middles of rims have to be apart to cross.
constexpr double kCoaxial = 1e-6;
// Of the angles.
constexpr double kTurned = 1e-15, kStands = 1e-9;

/// Two points of two rims.
class RimPair {
 public:
  RimPair(const RimPoint& one, const RimPoint& other) : one_(one), other_(other) {}

  /// @return false: the middles lie on each other
  bool begin(double towards) {
    Vector3d mean = one_.axis - other_.axis;
    mean = mean.norm() > 0.1 ? Vector3d(mean.normalized()) : one_.axis;
    Vector3d way = other_.centre - one_.centre;
    way -= mean.dot(way) * mean;
    const double apart = way.norm();
    if (apart < kCoaxial * (one_.radius + other_.radius)) return false;
    way /= apart;
    const double at =
        0.5 * (apart + (one_.radius - other_.radius) / apart * (one_.radius + other_.radius));
    const double along = std::clamp(at, -one_.radius, one_.radius);
    const double beside = std::sqrt(one_.radius * one_.radius - along * along);
    const Vector3d x = one_.centre + along * way + towards * beside * mean.cross(way);
    one_.turn_to(one_.nearest_to(x));
    other_.turn_to(other_.nearest_to(x));
    return true;
  }
  /// @return whether both points are nearest to each other
  bool find() {
    for (int k = 0; k < kFirstTurns; ++k) {
      other_.turn_to(other_.nearest_to(one_.place()));
      one_.turn_to(one_.nearest_to(other_.place()));
    }
    double size = 0.0;
    for (int k = 0; k < kMostTurns; ++k) {
      const Vector3d d = between();
      const Vector2d turn = solve({one_.tangent.dot(d), other_.tangent.dot(d)});
      size = turn.norm();
      if (!(size < 0.5)) return false;
      turn_by(one_, turn[0]);
      turn_by(other_, turn[1]);
      if (size < kTurned) break;
    }
    return size < kStands;
  }
  void set(TouchPlace& out) const {
    const Vector3d d = between(), rate = other_.rate() - one_.rate();
    const Vector2d around = solve({one_.turning().dot(d) + one_.tangent.dot(rate),
                                   other_.turning().dot(d) + other_.tangent.dot(rate)});
    const MovingPoint x = moving(one_, around[0]), y = moving(other_, around[1]);
    Crossing crossing(one_.tangent, tangent_rate(one_, around[0]), other_.tangent,
                      tangent_rate(other_, around[1]));
    if (crossing.lead(one_.axis + one_.radial - other_.axis - other_.radial)) {
      const bool leads_out = one_.sees(-crossing.normal) && other_.sees(crossing.normal);
      if (crossing.set(x, y, leads_out, std::min(one_.radius, other_.radius), out)) return;
    }
    set_points(x, y, 0.0, out);
  }

 private:
  Vector3d between() const { return other_.place() - one_.place(); }
  /// Angles, or their rates, that take away what both tangents see of the distance.
  Vector2d solve(const Vector2d& slopes) const {
    const Vector3d d = between();
    const double k = one_.tangent.dot(other_.tangent);
    Matrix2d A;
    A << -one_.radius - one_.radial.dot(d), other_.radius * k, -one_.radius * k,
        other_.radius - other_.radial.dot(d);
    if (std::abs(A.determinant()) < kAlongRim * one_.radius * other_.radius) {
      return Vector2d::Zero();
    }
    return -A.inverse() * slopes;
  }
  static void turn_by(RimPoint& point, double angle) {
    point.turn_to((std::cos(angle) * point.radial + std::sin(angle) * point.tangent).normalized());
  }
  static MovingPoint moving(const RimPoint& point, double around) {
    return {point.place(), point.rate() + point.radius * around * point.tangent};
  }
  static Vector3d tangent_rate(const RimPoint& point, double around) {
    return point.turning() - around * point.radial;
  }

  RimPoint one_, other_;
};

}  // namespace

void set_rim_over_rim(const Rim& first, const MarkerMotion& F, const Rim& rim,
                      const MarkerMotion& M, double towards, TouchPlace& out) {
  const RimPoint one(first, F), other(rim, M);
  const double reach = one.radius + other.radius;
  if ((other.centre - one.centre).squaredNorm() > 2.0 * reach * reach) {
    return set_points({one.centre, one.centre_rate()}, {other.centre, other.centre_rate()}, 0.0,
                      out);
  }
  RimPair pair(one, other);
  if (!pair.begin(towards) || !pair.find()) return set_apart(F, M, out);
  pair.set(out);
}

}  // namespace buckens::spatial
