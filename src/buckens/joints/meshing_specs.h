// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>
#include <optional>

#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

// Joints between wheels that turn with each other. Shafts are held by joints of their own.

/// Angles of involute teeth.
struct ToothAngles {
  double pressure_angle = std::numbers::pi / 9;  ///< [rad]
  double helix_angle = 0;                        ///< [rad]

  template <class Visitor>
  void tooth_fields(Visitor& visit, const char* helix) {
    visit(base::field("pressure-angle", pressure_angle,
                      "normal to the teeth: how much of their force pushes the shafts apart")
              .in(base::kAngle)
              .non_negative()
              .like("20 deg")
              .otherwise("20 deg"));
    visit(base::field("helix-angle", helix_angle, helix).in(base::kAngle).like("15 deg"));
  }
};

/// Backlash between rigid teeth, and impacts of their flanks.
struct ToothPlay {
  double backlash = 0;                ///< [m]
  std::optional<double> restitution;  ///< 0 … 1
  std::optional<double> threshold;    ///< [m/s]

  template <class Visitor>
  void play_fields(Visitor& visit) {
    visit(base::field("backlash", backlash,
                      "play on the pitch circle: teeth carry on either flank or on none; as "
                      "placed, they stand in the middle of it")
              .in(base::kLength)
              .non_negative()
              .like("0.1 mm"));
    visit(base::field("restitution", restitution,
                      "coefficient of restitution of flanks with play: speed of departure over "
                      "speed of approach, 0 … 1")
              .non_negative()
              .like("0.3")
              .otherwise("0: flanks stay together until they are pulled apart"));
    visit(base::field("threshold", threshold,
                      "speed of approach along the line of action up to which flanks do not "
                      "rebound")
              .in(base::kVelocity)
              .positive()
              .like("1 mm/s")
              .otherwise("a thousandth of the distance of the centres, or of the radius of a "
                         "rack's pinion, per second"));
  }
};

struct GearSpec : JointEndsAndAxis, ToothAngles, ToothPlay {
  static constexpr const char* kKey = "gear";
  static constexpr const char* kDoc =
      "two gears with parallel axes, markers at their centres; whatever carries the centres, fixed "
      "or turning, feels the whole force between the teeth";
  static constexpr const char* kInstead =
      "a gear couples the angles of two joints; name the joint on which one of the gears turns";
  std::array<double, 2> teeth{0, 0};
  bool internal = false;

  template <class Visitor>
  void fields(Visitor& visit) {
    axis_fields(visit);
    visit(
        base::field("teeth", teeth,
                    "numbers of teeth of the first and second gear; pitch circles follow from the "
                    "distance of the centres as placed")
            .positive()
            .required()
            .like("[20, 40]"));
    visit(base::field("internal", internal, "whether the gear with more teeth is a ring").on_off());
    tooth_fields(visit, "of the teeth; positive: those of the first gear are right-handed");
    play_fields(visit);
  }
};

struct RackSpec : JointEndsAndAxis, ToothAngles, ToothPlay {
  static constexpr const char* kKey = "rack";
  static constexpr const char* kDoc =
      "a toothed rack, which is the first body, and its pinion with the marker at its centre";
  static constexpr const char* kInstead =
      "a rack couples the coordinates of two joints; name that on which the pinion turns, or that "
      "on which the rack slides";
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< in the first marker
  double radius = 0;                                ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    axis_fields(visit);
    visit(base::field("along", along,
                      "direction in the first marker's axes in which a pinion that turns "
                      "right-handed about `axis` rolls on the rack")
              .required()
              .like("[1, 0, 0]"));
    visit(base::field("radius", radius, "of the pinion's pitch circle")
              .in(base::kLength)
              .positive()
              .required()
              .like("25 mm"));
    tooth_fields(visit, "of the teeth; positive: those of the rack are like a left-handed gear's");
    play_fields(visit);
  }
};

struct BeltSpec : JointEndsAndAxis {
  static constexpr const char* kKey = "belt";
  static constexpr const char* kDoc =
      "belt or chain over two pulleys with parallel axes, markers at their centres; it neither "
      "slips nor stretches, and its tension is not looked at";
  static constexpr const char* kInstead =
      "a belt couples the angles of two joints; name the joint on which one of the pulleys turns";
  std::array<double, 2> radii{0, 0};  ///< [m]
  bool crossed = false;

  template <class Visitor>
  void fields(Visitor& visit) {
    axis_fields(visit);
    visit(base::field("radii", radii, "of the first and second pulley")
              .in(base::kLength)
              .positive()
              .required()
              .like("[50 mm, 120 mm]"));
    visit(base::field("crossed", crossed, "whether the pulleys turn against each other").on_off());
  }
};

}  // namespace buckens::joints
