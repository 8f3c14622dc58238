// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/spatial/touch_features.h"

namespace buckens::spatial {

/// The rim of a flat end, in axes of its marker.
struct Rim {
  Eigen::Vector3d middle;  ///< [m]
  Eigen::Vector3d axis;    ///< unit vector out of the end
  double radius;           ///< [m]

  /// @param end 1 or −1
  static Rim of(const TouchSurface& cylinder, double end) {
    return {end * cylinder.half_length * cylinder.axis, end * cylinder.axis, cylinder.radius};
  }
};

/// A straight edge between two faces, in axes of its marker.
struct SharpEdge {
  Eigen::Vector3d middle;  ///< [m]
  Eigen::Vector3d along;   ///< unit vector
  double half_length;      ///< [m]
  /// Unit vectors across it, each going on beyond one of the faces. Normals of touching bodies lie
  /// between them; of a right angle they are the normals of both faces.
  std::array<Eigen::Vector3d, 2> beyond;

  /// Of a box. @param axis along it, @param one,other signs along the axes after it
  static SharpEdge of(const TouchSurface& box, int axis, double one, double other);
};

// Places of a rim of the second body. The normal leads from the first body to the second. What does
// not touch has a gap above zero, and rates that are exact but where it is said.

/// Where the rim is nearest to an edge, on one side of its middle, or on the other if that is
/// clearly nearer; between them, their gap across both. Beyond an end of the edge, and where
/// another part of either body is nearer, the distance of the points.
/// @return whether the gap is that across both, and leads out of both bodies
bool set_rim_over_edge(const SharpEdge& edge, const MarkerMotion& F, const Rim& rim,
                       const MarkerMotion& M, double towards, TouchPlace& out);

/// Where the rim is nearest to the curved side of a cylinder, on one side of its middle, or on the
/// other if that is clearly nearer. Beyond the cylinder's ends the gap is the distance of this
/// point, its rate that of the body's point.
void set_rim_over_side(const TouchSurface& cylinder, const MarkerMotion& F, const Rim& rim,
                       const MarkerMotion& M, double towards, TouchPlace& out);

/// The lowest point of a rim over a face, and its rate; where the end is level, one that stays in
/// the body.
/// @param normal out of the face, world axes
MovingPoint lowest_of_rim(const Rim& rim, const MarkerMotion& M, const Eigen::Vector3d& normal,
                          const Eigen::Vector3d& normal_rate);

/// The lowest point of the rim over a face of a box, or over an end of a cylinder, which look at
/// it. Beside the face the gap is the distance of this point, its rate that of the body's point.
/// @param axis of the box's face; of a cylinder: any
void set_rim_over_face(const TouchSurface& solid, int axis, const MarkerMotion& F, const Rim& rim,
                       const MarkerMotion& M, TouchPlace& out);

/// Where two rims cross, on one side of the line between their middles.
void set_rim_over_rim(const Rim& first, const MarkerMotion& F, const Rim& rim,
                      const MarkerMotion& M, double towards, TouchPlace& out);

/// A place of a rim seen by the row of a side, whose end it is past: the row lets go. Its normal is
/// turned round, so that what was closed would have to pull.
/// @param beyond how far it is past the end, or from where side and rim touch alike [m]
/// @param axis of the side
void leave_to_rim(double beyond, const Eigen::Vector3d& axis, double radius, TouchPlace& out);

/// What touches nowhere: the distance of both middles.
void set_apart(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out);

/// Two points and the radius around the first one.
void set_points(const MovingPoint& first, const MovingPoint& second, double radius,
                TouchPlace& out);

}  // namespace buckens::spatial
