// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

// Joints that guide points and directions along and about one axis.

struct CylindricalSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "cylindrical";
  static constexpr const char* kDoc = "rotates about the axis and slides along it";
  static constexpr bool kTurns = true, kSlides = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the axis in the first marker's axes");
  }
};

struct PlanarJointSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "planar";
  static constexpr const char* kDoc =
      "slides in a plane and rotates about its normal: a face on a face; its coordinate is the "
      "angle about the normal";
  static constexpr bool kTurns = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "normal of the plane in the first marker's axes");
  }
};

struct PointOnLineSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "point-on-line";
  static constexpr const char* kDoc =
      "the second marker stays on a line through the first; all rotations are free";
  static constexpr bool kSlides = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the line in the first marker's axes");
  }
};

struct PointInPlaneSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "point-in-plane";
  static constexpr const char* kDoc =
      "the second marker stays in a plane through the first; all rotations are free";
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "normal of the plane in the first marker's axes");
  }
};

struct ParallelSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "parallel";
  static constexpr const char* kDoc =
      "an axis keeps its direction in both bodies; they may translate and rotate about it; its "
      "coordinate is this angle";
  static constexpr bool kTurns = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the axis in the first marker's axes");
  }
};

struct OrientationSpec : JointEnds {
  static constexpr const char* kKey = "orientation";
  static constexpr const char* kDoc = "no relative rotation; all displacements are free";
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
  }
};

}  // namespace buckens::joints
