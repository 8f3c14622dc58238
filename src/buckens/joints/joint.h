// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/joints/constraint_row.h"
#include "buckens/joints/curve_pieces.h"
#include "buckens/spatial/plane.h"

namespace buckens::joints {

/// Kinds of ideal joints. The names are those of the model file.
enum class JointType {
  revolute,
  spherical,
  prismatic,
  fixed,
  prescribed_rotation,
  prescribed_translation,
  cylindrical,
  planar,
  universal,
  constant_velocity,
  point_on_line,
  point_in_plane,
  parallel,
  orientation,
  distance,
  screw,
  gear,
  rack,
  belt,
  slot,
  coupler,
  slider_on_beam,
  rolling,
  prescribed_coordinate
};

/// Name of the kind in the model file.
std::string to_string(JointType type);

/// Orientation of both marker frames as placed, and further data of the joint.
///
/// Joints keep the relative orientation of the bodies as placed: directions of M are images of F's
/// directions there, and prescribed angles and displacements are measured from it. Points should
/// coincide or lie on the axis; assembly closes gaps.
struct Placement {
  Eigen::Matrix3d R_WF = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_WM = Eigen::Matrix3d::Identity();
  Eigen::Vector3d r_F = Eigen::Vector3d::Zero();      ///< from F to M, in F [m]
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();  ///< joint axis in F, any non-zero length
  std::optional<spatial::Plane> planar;               ///< keep in-plane rows only
  std::optional<base::TimeLaw> law;                   ///< angle [rad] or displacement [m]
  std::optional<Eigen::Vector3d> second_axis_F;  ///< of universal, constant velocity, as placed
  std::optional<double> length;                  ///< of distance [m]; none: as placed
  double pitch = 0;                              ///< of screw [m] per turn
  std::array<double, 2> sizes{1, 1};             ///< teeth of gears, radii of belts and racks [m]
  bool same_sense = false;                       ///< internal gears, open belts
  double pressure_angle = 0;                     ///< of gears and racks [rad]
  double helix_angle = 0;                        ///< of gears and racks [rad]
  std::vector<Eigen::Vector3d> path;             ///< of a slot, in F [m]; or
  Eigen::Vector3d path_start = Eigen::Vector3d::Zero();  ///< where its pieces begin [m]
  std::vector<CurveStep> path_steps;                     ///< these, in F
  bool is_closed = false;                                ///< whether the path is
  std::optional<Eigen::Vector3d> path_normal_F;  ///< of a plane path; planar models need none
  /// For a prescribed rotation: a direction that turns with M, as placed, unit vector in F
  /// perpendicular to the axis; any if M turns about no other axis.
  std::optional<Eigen::Vector3d> mark_F;
  std::optional<Eigen::Vector3d> x_F;  ///< of planes: direction of x, none: the standard one
  bool as_found = false;               ///< whether a weld holds where it was attached
  double edge = 0;                     ///< of a wheel: radius of its rounded edge [m]
};

/// Rows of a joint of the given kind between two marker frames.
///
/// Rows per kind (planar in brackets): revolute 5 (2), spherical 3 (2), prismatic 5 (2), fixed 6
/// (3), prescribed rotation 1 (1), prescribed translation 1 (1), point on line 2 (1), point in
/// plane 1 (1), orientation 3 (1), distance 1 (1), gear, rack and belt 1 (1), slot 2 or,
/// with a normal, 1 (1), rolling 3 (2); in space only:
/// cylindrical 4, planar 3, universal 4, constant velocity 4, parallel 2, screw 5. Cost O(1).
/// @throws ModelError if the axis is zero or, in a planar model, neither normal to the plane
///         (revolute, prescribed rotation) nor in it (prismatic, prescribed translation, point on
///         line, point in plane); if the joint makes no sense in a plane or where it is placed; if
///         its second axis or its length does not suit it
std::vector<ConstraintRow> make_rows(JointType type, const Placement& placement);

/// Rows that keep two points together and the direction `axis_F` common to both markers, for two
/// bars that divide a longer one.
std::vector<ConstraintRow> make_straight_rows(const Placement& placement);

/// Unit vector of the joint axis in F.
Eigen::Vector3d unit_axis(const Placement& placement);

}  // namespace buckens::joints
