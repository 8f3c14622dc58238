// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// A surface about a marker, in the marker's axes. Its distance from a point is exact.
struct TouchSurface {
  /// A ring is the circle of this radius around the axis, `half_length` along it: a rim.
  enum class Kind { plane, sphere, socket, bore, capsule, cylinder, box, ring };

  Kind kind = Kind::plane;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector; of a plane: its normal
  double radius = 0;                                ///< [m]
  double half_length = 0;                           ///< of capsules and cylinders [m]
  Eigen::Vector3d half = Eigen::Vector3d::Zero();   ///< half the edges of a box [m]
  int flat = -1;  ///< axis of a box that points out of the plane of a planar model, −1: none

  /// What a point sees of it.
  struct View {
    double distance = 0;                                  ///< negative: inside the solid [m]
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();    ///< gradient of the distance
    Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  ///< its second derivatives [1/m]
  };
  /// @param with_curvature false: the second derivatives are left zero
  View look(const Eigen::Vector3d& point, bool with_curvature = true) const;

 private:
  /// Around a point, or around an axis.
  enum class Round { point, axis };
  View from_centre(const Eigen::Vector3d& out, Round round, double sign, bool with_curvature) const;
  static View from_ring(const View& beside, const View& beyond, bool with_curvature);
  View from_cylinder(const Eigen::Vector3d& point, bool with_curvature) const;
  View from_box(const Eigen::Vector3d& point, bool with_curvature) const;
};

}  // namespace buckens::spatial
