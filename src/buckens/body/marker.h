// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/pose.h"

namespace buckens::body {

/// A frame fixed to a body, FM (1): to the body frame, or to a point of its mesh.
///
/// On a mesh point the marker follows the interpolated displacement y_t = N_t d and rotation
/// θ = N_r d:  p_BF = z₀ + y_t,  R_BF = exp(θ~) R₀. Where the mesh has no rotations the marker
/// keeps the axes of the body frame and can carry no moment.
struct Marker {
  std::string name;
  spatial::Pose X_BF;        ///< in the undeformed body
  int translation_row = -1;  ///< first of three rows of FlexiblePart::rows; −1: rigid
  int rotation_row = -1;     ///< first of three rows; −1: no rotations at this point
  int node = -1;             ///< mesh node that carries it, −1 if none

  bool follows_mesh() const { return translation_row >= 0; }
  bool carries_moment() const { return !follows_mesh() || rotation_row >= 0; }
};

/// Pose and twist of a body frame B in the world.
struct FrameMotion {
  spatial::Pose X_WB;
  Eigen::Vector3d w = Eigen::Vector3d::Zero();  ///< angular velocity in body axes [rad/s]
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< velocity of the origin in world axes [m/s]
};

/// Motion of a marker, and the effect on the body of a force at the marker.
struct MarkerKinematics {
  spatial::MarkerMotion motion;
  Eigen::Matrix3d R_WB;          ///< body axes
  Eigen::Vector3d z;             ///< p_BF of the deformed body [m]
  Eigen::Matrix3d rotation_map;  ///< J_l(θ): nodal rotation rates → angular velocity, body axes

  /// Frame part of Jᵀ·wrench: torque about the body origin in body axes, then force in world axes.
  Eigen::Matrix<double, 6, 1> frame_load(const spatial::Wrench& wrench) const;
  /// Interface part of Jᵀ·wrench: on y_t, then on θ.
  Eigen::Matrix<double, 6, 1> interface_load(const spatial::Wrench& wrench) const;
};

/// Evaluates a marker.
/// @param y, y_dot values and rates of the body's marker rows (empty for rigid bodies)
MarkerKinematics marker_kinematics(const Marker& marker, const FrameMotion& frame,
                                   const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot);

/// Acceleration of the marker if ẇ, v̇ and ÿ are zero.
spatial::MarkerBias marker_bias(const Marker& marker, const FrameMotion& frame,
                                const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot);

}  // namespace buckens::body
