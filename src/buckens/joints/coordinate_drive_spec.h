// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/base/coordinate_choice.h"
#include "buckens/base/field.h"
#include "buckens/base/motion_dimensions.h"
#include "buckens/joints/drive_laws.h"

namespace buckens::joints {

/// Drives a coordinate of another joint.
struct PrescribedCoordinateSpec {
  static constexpr const char* kKey = "prescribed-coordinate";
  static constexpr const char* kDoc =
      "drives a coordinate of another joint, such as the way along a slot or the second angle of a "
      "universal joint, by `angle`, `speed` or `angular-acceleration`, or by `displacement`, "
      "`velocity` or `acceleration`";
  static constexpr const char* kInstead = "name the joint that it drives";
  std::string joint;
  std::optional<base::CoordinateChoice> which;
  // Exactly one of the six is given.
  std::optional<base::SignalLaw> angle, speed, angular_acceleration;    ///< [rad], /s, /s²
  std::optional<base::SignalLaw> displacement, velocity, acceleration;  ///< [m], /s, /s²

  bool drives_angle() const { return angle || speed || angular_acceleration; }
  base::CoordinateSort sort() const {
    return drives_angle() ? base::CoordinateSort::angles : base::CoordinateSort::displacements;
  }
  int num_given() const {
    return DriveLaws{angle, speed, angular_acceleration}.num_given() +
           DriveLaws{displacement, velocity, acceleration}.num_given();
  }
  DriveLaws laws() const {
    return drives_angle() ? DriveLaws{angle, speed, angular_acceleration}
                          : DriveLaws{displacement, velocity, acceleration};
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("joint", joint, "name of the joint").required().like("bead"));
    visit(base::field("which", which, "of joints with several coordinates")
              .like("x")
              .otherwise("the angle or the displacement of the joint, or its only coordinate of "
                         "this sort"));
    law_fields(visit);
  }

 private:
  template <class Visitor>
  void law_fields(Visitor& visit) {
    static constexpr const char* kOne = "give one of the six laws";
    visit(base::field("angle", angle,
                      "the angle, counted over turns from as placed; a formula of t and signals "
                      "whose rate has no jumps: of states of blocks, no measured angles or speeds")
              .in(base::kAngle)
              .like("\"0.2*sin(5*t)\"")
              .otherwise(kOne));
    visit(base::field("speed", speed,
                      "rate of the angle, which begins as placed; a formula of t and signals, but "
                      "of measured speeds and forces only behind a `lag` or an `integral`")
              .in(base::kAngularVelocity)
              .like("2 rad/s")
              .otherwise(kOne));
    visit(base::field("angular-acceleration", angular_acceleration,
                      "of the angle, a formula of t and signals; it begins at rest as placed")
              .in(base::kAngularAcceleration)
              .like("\"20*sin(5*t) rad/s^2\"")
              .otherwise(kOne));
    visit(base::field("displacement", displacement,
                      "the displacement, from as placed; a formula of t and signals whose rate has "
                      "no jumps: of states of blocks, no measured places or velocities")
              .in(base::kLength)
              .like("\"10*sin(20*t) mm\"")
              .otherwise(kOne));
    visit(base::field("velocity", velocity,
                      "rate of the displacement, which begins as placed; a formula of t and "
                      "signals, but of measured velocities and forces only behind a `lag` or an "
                      "`integral`")
              .in(base::kVelocity)
              .like("0.2 m/s")
              .otherwise(kOne));
    visit(
        base::field("acceleration", acceleration,
                    "of the displacement, a formula of t and signals; it begins at rest as placed")
            .in(base::kAcceleration)
            .like("\"2*sin(5*t) m/s^2\"")
            .otherwise(kOne));
  }
};

}  // namespace buckens::joints
