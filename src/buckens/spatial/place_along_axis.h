// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "buckens/spatial/touch_features.h"

namespace buckens::spatial {

/// Where the distance of the points r + s b of a segment from a surface has its least value, up to
/// rounding, by Newton's method or halving.
/// @param see (s) → TouchSurface::View, @param low,high on either side of it, @param s a first
/// guess
template <class See>
double least_along(const See& see, const Eigen::Vector3d& b, double low, double s, double high) {
  constexpr int kMostRefinements = 60;
  // Of the parameter, which is of the order of one.
  constexpr double kRefined = 1e-15;
  for (int k = 0; k < kMostRefinements && high - low > kRefined; ++k) {
    const TouchSurface::View view = see(s);
    const double now = view.normal.dot(b);
    (now < 0.0 ? low : high) = s;
    const double curve = b.dot(view.curvature * b);
    if (std::abs(now) <= kRefined * curve) break;
    const double next = s - now / curve;
    s = curve > 0.0 && next > low && next < high ? next : 0.5 * (low + high);
  }
  return s;
}

/// A place of a capsule's axis at a surface of `other` (C14, C17).
/// @param s along the axis, in halves of it, @param is_free it stays where the distance is least
/// @param view what the point there sees of the surface, in axes of `other`
inline void set_on_axis(const TouchSurface::View& view, const MarkerMotion& other,
                        const TouchSurface& capsule, const MarkerMotion& owner, double s,
                        bool is_free, TouchPlace& out) {
  const Eigen::Vector3d half = owner.R * (capsule.half_length * capsule.axis);
  MovingPoint point{owner.p + s * half, owner.v + owner.w.cross(s * half)};
  const Eigen::Vector3d b = other.R.transpose() * half;
  const double curve = b.dot(view.curvature * b);
  if (is_free && curve > 0.0) {
    // The axis stays at right angles to the normal.
    const Eigen::Vector3d own =
        other.R.transpose() * (point.rate - other.v - other.w.cross(point.x - other.p));
    const Eigen::Vector3d b_rate = other.R.transpose() * (owner.w - other.w).cross(half);
    point.rate -= (b.dot(view.curvature * own) + view.normal.dot(b_rate)) / curve * half;
  }
  set_sphere_at(view, other, point, capsule.radius, out);
}

}  // namespace buckens::spatial
