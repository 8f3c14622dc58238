// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/base/motion_dimensions.h"
#include "buckens/joints/drive_laws.h"
#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

// Joints whose place on their bodies changes as they move.

/// At most one of the three laws is given.
struct SliderOnBeamSpec : JointEnds {
  static constexpr const char* kKey = "slider-on-beam";
  static constexpr const char* kDoc =
      "a point that slides along a flexible beam, deformed as it is; all rotations are free";
  static constexpr std::array kCoordinates{base::CoordinateChoice::displacement};
  std::optional<std::string> from, to;          ///< nodes of the beam
  std::optional<base::SignalLaw> displacement;  ///< along the beam, from as placed [m]
  std::optional<base::SignalLaw> velocity;      ///< [m/s]
  std::optional<base::SignalLaw> acceleration;  ///< [m/s²]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(
        base::field("between", between, "the flexible body with the beam, and the slider's marker")
            .required()
            .like("[rail, trolley]"));
    visit(base::field("from", from, "node of the first body where the way along its beams begins")
              .like("start")
              .otherwise("an end of the only line of beams, the one that is its first node"));
    visit(base::field("to", to, "node where the way ends")
              .like("end")
              .otherwise("the other end of the only line of beams"));
    visit(base::field(
              "displacement", displacement,
              "drives the slider: its way along the undeformed beam from where it is placed; a "
              "formula of t and signals whose rate has no jumps: of states of blocks, no "
              "measured places or velocities")
              .in(base::kLength)
              .like("\"2*t m\"")
              .otherwise("it slides freely"));
    visit(
        base::field(
            "velocity", velocity,
            "drives the slider along the beam; its way is the integral from t = 0; a formula of t "
            "and signals, but of measured velocities and forces only behind a `lag` or "
            "an `integral`")
            .in(base::kVelocity)
            .like("20 m/s")
            .otherwise("it slides freely"));
    visit(base::field(
              "acceleration", acceleration,
              "drives the slider along the beam, a formula of t and signals; it begins at rest")
              .in(base::kAcceleration)
              .like("2 m/s^2")
              .otherwise("it slides freely"));
  }

  DriveLaws laws() const { return {displacement, velocity, acceleration}; }
  bool is_driven() const { return laws().num_given() > 0; }
};

struct RollingSpec : JointEnds {
  static constexpr const char* kKey = "rolling";
  static constexpr const char* kDoc =
      "a wheel that rolls on a plane without slip; the plane goes through the first marker, the "
      "second is the wheel's centre";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle,
                                           base::CoordinateChoice::displacement};
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the plane, in the first marker
  std::optional<Eigen::Vector3d> axle;               ///< of the wheel, in the second marker
  double wheel_radius = 0;                           ///< [m]
  double edge = 0;                                   ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(
        base::field("normal", normal, "of the plane in the first marker's axes, towards the wheel")
            .required()
            .like("[0, 0, 1]"));
    visit(base::field("axle", axle, "axis of the wheel in the second marker's axes")
              .like("[0, 1, 0]")
              .otherwise("planar models: the normal of the plane of the model"));
    visit(base::field("radius", wheel_radius, "of the wheel, from its axis to the outermost place")
              .in(base::kLength)
              .positive()
              .required()
              .like("0.3 m"));
    visit(base::field("edge-radius", edge,
                      "of the rounded edge of a wheel, such as a tyre's; 0: a sharp disc; the "
                      "wheel's radius: a sphere")
              .in(base::kLength)
              .non_negative()
              .like("20 mm"));
  }
};

}  // namespace buckens::joints
