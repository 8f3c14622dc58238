// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/base/motion_dimensions.h"
#include "buckens/base/signal_law.h"
#include "buckens/loads/joint_law_spec.h"

namespace buckens::loads {

/// A motor on a joint coordinate, with its commands and limits.
struct MotorSpec : JointLaw {
  std::optional<base::SignalLaw> force;     ///< [N m] or [N]
  std::optional<base::SignalLaw> position;  ///< aimed at [rad] or [m]
  std::optional<base::SignalLaw> speed;     ///< aimed at [rad/s] or [m/s]
  base::SignalLaw stiffness;                ///< [N m/rad] or [N/m]
  base::SignalLaw damping;                  ///< [N m s/rad] or [N s/m]
  std::optional<base::SignalLaw> limit;     ///< [N m] or [N]
  std::optional<base::SignalLaw> power;     ///< [W]
  std::optional<double> return_time;        ///< of an exact one with a position [s]

  /// Without gains it follows its speed or position exactly.
  bool is_exact() const {
    return (speed || return_time) && stiffness.is_number(0.0) && damping.is_number(0.0);
  }

  template <class Visitor>
  void motor_fields(Visitor& visit, bool turns) {
    joint_fields(visit, turns);
    visit(base::field(turns ? "torque" : "force", force,
                      turns ? "torque along the angle, by time and signals; added to what the "
                              "gains give"
                            : "force along the displacement, by time and signals; added to what "
                              "the gains give")
              .in(turns ? base::kTorque : base::kForce)
              .like(turns ? "\"2*sin(20*t) N m\"" : "\"50*sin(20*t) N\"")
              .otherwise("none"));
    visit(base::field(
              turns ? "angle" : "displacement", position,
              "target of `stiffness`, or of a `return-time`, counted from the position as placed; "
              "by time and signals")
              .in(turns ? base::kAngle : base::kLength)
              .like(turns ? "\"0.5*sin(2*t) rad\"" : "\"50*sin(2*t) mm\"")
              .otherwise("none"));
    visit(
        base::field(turns ? "speed" : "velocity", speed,
                    "target of `damping`; without gains, held exactly as far as the limit admits; "
                    "by time and signals")
            .in(turns ? base::kAngularVelocity : base::kVelocity)
            .like(turns ? "1500 rpm" : "0.2 m/s")
            .otherwise(turns ? "the rate of a law of time for `angle`, else 0"
                             : "the rate of a law of time for `displacement`, else 0"));
    visit(base::field("stiffness", stiffness,
                      "gain on the error of the position, by time and signals")
              .in(turns ? base::kRotationalStiffness : base::kStiffness)
              .non_negative()
              .like(turns ? "200 N m/rad" : "5 kN/m"));
    visit(base::field("damping", damping, "gain on the error of the speed, by time and signals")
              .in(turns ? base::kRotationalDamping : base::kDamping)
              .non_negative()
              .like(turns ? "5 N m s/rad" : "80 N s/m"));
    visit(base::field(turns ? "torque-limit" : "force-limit", limit,
                      "largest magnitude, either way; the motor stalls there; by time and signals")
              .in(turns ? base::kTorque : base::kForce)
              .positive()
              .like(turns ? "12 N m" : "400 N")
              .otherwise("none"));
    visit(base::field("power-limit", power,
                      "largest power delivered, by time and signals; braking has no such limit")
              .in(base::kPower)
              .positive()
              .like("250 W")
              .otherwise("none"));
    visit(base::field("return-time", return_time,
                      turns ? "of a motor without gains: it follows its `angle` exactly as far as "
                              "its limits admit, and an error that is left when it could not fades "
                              "to 1/e in this time; five steps at least"
                            : "of a motor without gains: it follows its `displacement` exactly as "
                              "far as its limits admit, and an error that is left when it could "
                              "not fades to 1/e in this time; five steps at least")
              .in(base::kTime)
              .positive()
              .like("20 ms")
              .otherwise("none: a position is held by `stiffness`"));
  }
};

/// A brake on a joint coordinate.
struct BrakeSpec : JointLaw {
  base::SignalLaw bound;  ///< [N m] or [N]

  template <class Visitor>
  void brake_fields(Visitor& visit, bool turns) {
    joint_fields(visit, turns);
    visit(base::field(turns ? "torque" : "force", bound,
                      "most that it resists with, by time and signals; below zero counts as zero")
              .in(turns ? base::kTorque : base::kForce)
              .required()
              .like(turns ? "\"40*pedal N m\"" : "\"500*pedal N\""));
  }
};

struct HingeBrakeSpec : BrakeSpec {
  static constexpr const char* kKey = "hinge-brake";
  static constexpr const char* kDoc =
      "brake on the angle of a joint: resists with a torque, and holds without any motion";
  static constexpr bool kTurns = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    brake_fields(visit, kTurns);
  }
};

struct SlideBrakeSpec : BrakeSpec {
  static constexpr const char* kKey = "slide-brake";
  static constexpr const char* kDoc =
      "brake on the displacement of a joint: resists with a force, and holds without any motion";
  static constexpr bool kTurns = false;
  template <class Visitor>
  void fields(Visitor& visit) {
    brake_fields(visit, kTurns);
  }
};

struct HingeMotorSpec : MotorSpec {
  static constexpr const char* kKey = "hinge-motor";
  static constexpr const char* kDoc =
      "motor on the angle of a joint: torque by a law or signal, gains on angle and speed, with "
      "limits";
  static constexpr bool kTurns = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    motor_fields(visit, kTurns);
  }
};

struct SlideMotorSpec : MotorSpec {
  static constexpr const char* kKey = "slide-motor";
  static constexpr const char* kDoc =
      "motor on the displacement of a joint: force by a law or signal, gains on displacement and "
      "velocity, with limits";
  static constexpr bool kTurns = false;
  template <class Visitor>
  void fields(Visitor& visit) {
    motor_fields(visit, kTurns);
  }
};

}  // namespace buckens::loads
