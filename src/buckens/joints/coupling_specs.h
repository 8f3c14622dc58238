// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

// Joints between shafts, and those of length and pitch.

struct UniversalSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "universal";
  static constexpr const char* kDoc =
      "cross joint: turns about one arm of the cross held by the first body and about the other "
      "held by the second";
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
  static constexpr const char* kDoc = "joint of two shafts that turn at the same speed at any bend";
  std::optional<Eigen::Vector3d> second_axis;  ///< in the first marker, as placed
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the first shaft in the first marker's axes");
    visit(base::field("second-axis", second_axis,
                      "direction in which the second shaft goes on, as placed, in the first "
                      "marker's axes; less than 85 degrees from `axis`")
              .like("[1, 0, 1]")
              .otherwise("that of `axis`: both shafts in line as placed"));
  }
};

struct DistanceSpec : JointEnds {
  static constexpr const char* kKey = "distance";
  static constexpr const char* kDoc = "massless rod with a ball joint at either marker";
  std::optional<double> length;  ///< [m]
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("length", length, "distance that the markers keep")
              .in(base::kLength)
              .positive()
              .like("200 mm")
              .otherwise("the distance as placed"));
  }
};

struct ScrewSpec : JointEndsAndDirection {
  static constexpr const char* kKey = "screw";
  static constexpr const char* kDoc =
      "turns about the axis and is driven along it by the pitch with each turn";
  static constexpr bool kTurns = true, kSlides = true;
  double pitch = 0;  ///< [m] per turn
  template <class Visitor>
  void fields(Visitor& visit) {
    direction_fields(visit, "direction of the axis in the first marker's axes");
    visit(base::field("pitch", pitch,
                      "displacement per turn; positive: the second marker goes along the axis as "
                      "it turns right-handed about it")
              .in(base::kLength)
              .required()
              .like("5 mm"));
  }
};

}  // namespace buckens::joints
