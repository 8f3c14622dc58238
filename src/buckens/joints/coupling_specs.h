// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

// Joints between shafts, and those with a length or pitch.

struct UniversalSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "universal";
  static constexpr const char* kDoc =
      "Cardan joint: rotates about one arm of the cross held by the first body and about the other "
      "held by the second, its coordinates `angle` and `second-angle`";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle,
                                           base::CoordinateChoice::second_angle};
  Eigen::Vector3d second_axis = Eigen::Vector3d::Zero();  ///< in the first marker, as placed
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "arm of the cross held by the first body, in the first marker's axes");
    visit(base::field("second-axis", second_axis,
                      "arm held by the second body, as placed, in the first marker's axes; "
                      "perpendicular to `axis`")
              .required()
              .like("[0, 1, 0]"));
  }
};

struct ConstantVelocitySpec : JointEndsAndDirection {
  static constexpr const char* kKey = "constant-velocity";
  static constexpr const char* kDoc =
      "joint between two shafts that rotate at the same speed at any angle; its coordinate `swing` "
      "is the angle between them";
  static constexpr std::array kCoordinates{base::CoordinateChoice::swing};
  std::optional<Eigen::Vector3d> second_axis;  ///< in the first marker, as placed
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the first shaft in the first marker's axes");
    visit(base::field("second-axis", second_axis,
                      "direction of the second shaft away from the first, as placed, in the first "
                      "marker's axes; less than 85 degrees from `axis`")
              .like("[1, 0, 1]")
              .otherwise("that of `axis`: both shafts collinear as placed"));
  }
};

struct DistanceSpec : JointEnds {
  static constexpr const char* kKey = "distance";
  static constexpr const char* kDoc = "massless rod with a ball joint at each marker";
  static constexpr const char* kInstead =
      "a rod moves as its ends do; name the joints at these, or observe a marker by `relative`";
  std::optional<double> length;  ///< [m]
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("length", length, "distance between the markers")
              .in(base::kLength)
              .positive()
              .like("200 mm")
              .otherwise("the distance as placed"));
  }
};

struct ScrewSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "screw";
  static constexpr const char* kDoc =
      "rotates about the axis and advances along it by the pitch per turn";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle,
                                           base::CoordinateChoice::displacement};
  double pitch = 0;  ///< [m] per turn
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the axis in the first marker's axes");
    visit(base::field("pitch", pitch,
                      "displacement per turn; positive: the second marker moves along the axis as "
                      "it rotates about it by the right-hand rule")
              .in(base::kLength)
              .required()
              .like("5 mm"));
  }
};

}  // namespace buckens::joints
