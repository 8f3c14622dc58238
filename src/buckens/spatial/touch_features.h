// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/rigid_touch.h"

namespace buckens::spatial {

/// A point in space and its rate, world axes.
struct MovingPoint {
  Eigen::Vector3d x;     ///< [m]
  Eigen::Vector3d rate;  ///< [m/s]

  /// @param at in axes of the marker
  static MovingPoint of(const MarkerMotion& owner, const Eigen::Vector3d& at) {
    const Eigen::Vector3d lever = owner.R * at;
    return {owner.p + lever, owner.v + owner.w.cross(lever)};
  }
};

/// A segment with round ends; without a radius: an edge.
struct RoundSegment {
  Eigen::Vector3d middle;  ///< in axes of its marker [m]
  Eigen::Vector3d half;    ///< from there to one end [m]
  double radius = 0;       ///< [m]
};

/// A sphere at a surface of `other`, the normal out of that; the place is halfway between both, on
/// planes that of the sphere.
void set_sphere_at(const TouchSurface& surface, const MarkerMotion& other, const MovingPoint& point,
                   double radius, TouchPlace& out);
/// The same where the surface is known by what the point sees of it, in axes of `other`.
void set_sphere_at(const TouchSurface::View& view, const MarkerMotion& other,
                   const MovingPoint& point, double radius, TouchPlace& out);

/// The nearest places of two segments, the first with F.
/// @param otherwise normal where they meet
void set_segments(const RoundSegment& first, const MarkerMotion& F, const RoundSegment& second,
                  const MarkerMotion& M, const Eigen::Vector3d& otherwise, TouchPlace& out);

/// An edge in world axes: its middle, and half of it.
struct MovingEdge {
  const MarkerMotion* owner;
  Eigen::Vector3d middle, half;  ///< [m]
  Eigen::Vector3d rate() const { return owner->v + owner->w.cross(middle - owner->p); }
  Eigen::Vector3d half_rate() const { return owner->w.cross(half); }
};

/// Where an edge of the first body crosses one of the second, the gap along what is normal to both.
/// @param along about from the first to the second, @pre the edges are not parallel
void set_crossing(const MovingEdge& first, const MovingEdge& second, const Eigen::Vector3d& along,
                  TouchPlace& out);

/// The second body becomes the first.
inline void turn_round(TouchPlace& out) {
  out.normal = -out.normal;
  out.normal_rate = -out.normal_rate;
}

}  // namespace buckens::spatial
