// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

// Joints that guide points and directions along and about one axis.

struct CylindricalSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "cylindrical";
  static constexpr const char* kDoc = "rotates about the axis and slides along it";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle,
                                           base::CoordinateChoice::displacement};
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the axis in the first marker's axes");
  }
};

/// The direction of x in a plane; y is normal × x.
template <class Visitor>
void visit_x_axis(Visitor& visit, std::optional<Eigen::Vector3d>& x_axis) {
  visit(base::field("along", x_axis,
                    "direction of `x` in the first marker's axes, as far as it lies in the plane; "
                    "`y` is 90 degrees ahead of it about `axis`")
            .like("[1, 0, 0]")
            .otherwise("the first marker's x axis, or its y axis where `axis` is within 30 degrees "
                       "of that; planar models: the direction in the plane of the model"));
}

struct PlanarJointSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "planar";
  static constexpr const char* kDoc =
      "slides in a plane and rotates about its normal: a face on a face; its coordinates are the "
      "`angle` about the normal and the displacements `x` and `y` in the plane";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle, base::CoordinateChoice::x,
                                           base::CoordinateChoice::y};
  std::optional<Eigen::Vector3d> x_axis;  ///< in the first marker
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "normal of the plane in the first marker's axes");
    visit_x_axis(visit, x_axis);
  }
};

struct PointOnLineSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "point-on-line";
  static constexpr const char* kDoc =
      "the second marker stays on a line through the first; all rotations are free";
  static constexpr std::array kCoordinates{base::CoordinateChoice::displacement};
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the line in the first marker's axes");
  }
};

struct PointInPlaneSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "point-in-plane";
  static constexpr const char* kDoc =
      "the second marker stays in a plane through the first; all rotations are free; its "
      "coordinates are the displacements `x` and `y` in the plane";
  static constexpr std::array kCoordinates{base::CoordinateChoice::x, base::CoordinateChoice::y};
  std::optional<Eigen::Vector3d> x_axis;  ///< in the first marker
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "normal of the plane in the first marker's axes");
    visit_x_axis(visit, x_axis);
  }
};

struct ParallelSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "parallel";
  static constexpr const char* kDoc =
      "an axis keeps its direction in both bodies; they may translate and rotate about it; its "
      "coordinate is this angle";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle};
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the axis in the first marker's axes");
  }
};

struct OrientationSpec : JointEnds {
  static constexpr const char* kKey = "orientation";
  static constexpr const char* kDoc =
      "no relative rotation; all displacements are free: its coordinates `x`, `y` and `z` along "
      "the "
      "first marker's axes";
  static constexpr std::array kCoordinates{base::CoordinateChoice::x, base::CoordinateChoice::y,
                                           base::CoordinateChoice::z};
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
  }
};

}  // namespace buckens::joints
