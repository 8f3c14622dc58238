// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "buckens/base/characteristic.h"
#include "buckens/base/coordinate_choice.h"
#include "buckens/base/field.h"
#include "buckens/base/signal_law.h"

namespace buckens::loads {

// Laws on the coordinate of a joint: its angle, including whole turns, or its displacement. Both
// are zero as placed.

/// Common to all joint laws.
struct JointLaw {
  std::string joint;
  std::optional<base::CoordinateChoice> which;

  template <class Visitor>
  void joint_fields(Visitor& visit, bool turns) {
    visit(base::field("joint", joint,
                      turns ? "name of a joint with an angle: one that rotates about an axis, or "
                              "swings and twists"
                            : "name of a joint with a displacement: one that slides along an axis "
                              "or a curve, or in a plane")
              .required()
              .like(turns ? "hinge" : "slide"));
    visit(base::field("which", which,
                      turns ? "of universal joints: `angle` about the arm that the first body "
                              "holds, or `second-angle` about that of the second; of ball joints: "
                              "`swing` or `twist`"
                            : "of planes and free translations: `x`, `y` or `z`")
              .like(turns ? "second-angle" : "y")
              .otherwise(turns ? "`angle`, or the only angle of the joint"
                               : "`displacement`, or the only displacement of the joint"));
  }
};

struct HingeSpringSpec : JointLaw {
  static constexpr const char* kKey = "hinge-spring";
  static constexpr const char* kDoc =
      "linear torsional spring and damper on the angle of a joint, over any number of turns";
  static constexpr bool kTurns = true;
  base::SignalLaw stiffness;                           ///< [N m/rad]
  base::SignalLaw damping;                             ///< [N m s/rad]
  base::SignalLaw angle;                               ///< torque-free [rad]
  std::optional<base::Characteristic> characteristic;  ///< [N m] by angle and rate

  template <class Visitor>
  void fields(Visitor& visit) {
    joint_fields(visit, kTurns);
    visit(base::field("stiffness", stiffness, "spring rate, by time and signals")
              .in(base::kRotationalStiffness)
              .non_negative()
              .like("20 N m/rad"));
    visit(base::field("damping", damping, "damper rate, by time and signals")
              .in(base::kRotationalDamping)
              .non_negative()
              .like("0.1 N m s/rad"));
    visit(
        base::field("angle", angle, "angle at which the spring is torque-free, by time and signals")
            .in(base::kAngle)
            .like("10 deg"));
    visit(base::field("characteristic", characteristic,
                      "torque against the turn as a formula in `angle` (from that free of torque) "
                      "and `rate`, or a table of the angle in rad; added to spring and damper")
              .in(base::kTorque)
              .like("\"20*angle + 300*angle^3 N m\"")
              .otherwise("none"));
  }
};

struct SlideSpringSpec : JointLaw {
  static constexpr const char* kKey = "slide-spring";
  static constexpr const char* kDoc = "linear spring and damper on the displacement of a joint";
  static constexpr bool kTurns = false;
  base::SignalLaw stiffness;                           ///< [N/m]
  base::SignalLaw damping;                             ///< [N s/m]
  base::SignalLaw displacement;                        ///< force-free [m]
  std::optional<base::Characteristic> characteristic;  ///< [N] by displacement and rate

  template <class Visitor>
  void fields(Visitor& visit) {
    joint_fields(visit, kTurns);
    visit(base::field("stiffness", stiffness, "spring rate, by time and signals")
              .in(base::kStiffness)
              .non_negative()
              .like("2 kN/m"));
    visit(base::field("damping", damping, "damper rate, by time and signals")
              .in(base::kDamping)
              .non_negative()
              .like("5 N s/m"));
    visit(base::field("displacement", displacement,
                      "displacement at which the spring is force-free, by time and signals")
              .in(base::kLength)
              .like("10 mm"));
    visit(base::field("characteristic", characteristic,
                      "force against the slide as a formula in `displacement` (from that free of "
                      "force) and `rate`, or a table of the displacement in m; added to spring and "
                      "damper")
              .in(base::kForce)
              .like("\"200*displacement + 5*rate*abs(rate) N\"")
              .otherwise("none"));
  }
};

/// Limits of the free range of a joint: elastic with a stiffness, otherwise rigid.
struct JointStop : JointLaw {
  std::optional<double> from, to;     ///< [rad] or [m]
  std::optional<double> stiffness;    ///< [N m/rad] or [N/m]
  double damping = 0;                 ///< [N m s/rad] or [N s/m]
  std::optional<double> restitution;  ///< of rigid stops, 0 … 1
  std::optional<double> threshold;    ///< [rad/s] or [m/s]

  template <class Visitor>
  void stop_fields(Visitor& visit, bool turns) {
    joint_fields(visit, turns);
    visit(base::field("from", from,
                      "where the free range begins, measured from the position as placed")
              .in(turns ? base::kAngle : base::kLength)
              .like(turns ? "-30 deg" : "-20 mm")
              .otherwise("no stop on this side"));
    visit(base::field("to", to, "where the free range ends, measured from the position as placed")
              .in(turns ? base::kAngle : base::kLength)
              .like(turns ? "90 deg" : "50 mm")
              .otherwise("no stop on this side"));
    visit(base::field("stiffness", stiffness, "of elastic stops")
              .in(turns ? base::kRotationalStiffness : base::kStiffness)
              .positive()
              .like(turns ? "1e4 N m/rad" : "1e6 N/m")
              .otherwise("the stops are rigid"));
    visit(base::field("damping", damping,
                      "of elastic stops; its force is at most that of their stiffness")
              .in(turns ? base::kRotationalDamping : base::kDamping)
              .non_negative()
              .like(turns ? "10 N m s/rad" : "100 N s/m"));
    visit(base::field("restitution", restitution,
                      "coefficient of restitution of a rigid stop: speed of departure over speed "
                      "of approach, 0 … 1")
              .non_negative()
              .like("0.4")
              .otherwise("0: it stays there until it is pulled off"));
    visit(base::field("threshold", threshold,
                      "speed of approach up to which a rigid stop causes no rebound")
              .in(turns ? base::kAngularVelocity : base::kVelocity)
              .positive()
              .like(turns ? "1e-3 rad/s" : "1 mm/s")
              .otherwise(turns ? "1e-3 rad/s" : "a thousandth of the model's size per second"));
  }
};

struct HingeStopSpec : JointStop {
  static constexpr const char* kKey = "hinge-stop";
  static constexpr const char* kDoc =
      "elastic or rigid stops of the angle of a joint, which never pull";
  static constexpr bool kTurns = true;
  template <class Visitor>
  void fields(Visitor& visit) {
    stop_fields(visit, kTurns);
  }
};

struct SlideStopSpec : JointStop {
  static constexpr const char* kKey = "slide-stop";
  static constexpr const char* kDoc =
      "elastic or rigid stops of the displacement of a joint, which never pull";
  static constexpr bool kTurns = false;
  template <class Visitor>
  void fields(Visitor& visit) {
    stop_fields(visit, kTurns);
  }
};

/// Model of sticking in dry friction.
enum class FrictionStick { elastic, rigid, bristles };

constexpr std::array<const char*, 3> choice_names(FrictionStick) {
  return {"elastic", "rigid", "bristles"};
}

/// Dry friction, from the reaction of the joint.
struct JointFrictionBase : JointLaw {
  base::SignalLaw coefficient;             ///< of sticking, μ_s
  std::optional<base::SignalLaw> dynamic;  ///< of sliding, μ_d; default: the same
  std::optional<double> stribeck;          ///< [rad/s] or [m/s]
  base::SignalLaw viscous;                 ///< [N m s/rad] or [N s/m]
  base::SignalLaw preload;                 ///< [N m] or [N]
  std::optional<double> slip;              ///< [rad] or [m]
  FrictionStick stick = FrictionStick::elastic;
  std::optional<double> bristle_stiffness;  ///< σ₀ [N m/rad] or [N/m]
  std::optional<double> bristle_damping;    ///< σ₁ [N m s/rad] or [N s/m]
  double elastic_share = 0.9;
  std::optional<double> length;  ///< of the bearing [m]

  template <class Visitor>
  void law_fields(Visitor& visit, bool turns) {
    visit(base::field("static", coefficient,
                      "coefficient of friction while it sticks, by time and signals")
              .non_negative()
              .like("0.15"));
    visit(base::field("dynamic", dynamic,
                      "coefficient of friction while it slides, by time and signals")
              .non_negative()
              .like("0.1")
              .otherwise("the same as `static`"));
    visit(base::field("stribeck-velocity", stribeck,
                      "rate at which the coefficient has dropped from `static` towards `dynamic` "
                      "by 63 %; needed if they differ")
              .in(turns ? base::kAngularVelocity : base::kVelocity)
              .positive()
              .like(turns ? "0.1 rad/s" : "10 mm/s")
              .otherwise("none"));
    visit(base::field("viscous", viscous,
                      "damper rate in addition to dry friction, by time and signals")
              .in(turns ? base::kRotationalDamping : base::kDamping)
              .non_negative()
              .like(turns ? "0.01 N m s/rad" : "1 N s/m"));
    visit(base::field("preload", preload,
                      "resistance without any reaction, as of seals; by time and signals")
              .in(turns ? base::kTorque : base::kForce)
              .non_negative()
              .like(turns ? "0.2 N m" : "5 N"));
    visit(base::field("slip", slip, "elastic displacement at which the joint breaks away")
              .in(turns ? base::kAngle : base::kLength)
              .positive()
              .like(turns ? "1e-5 rad" : "1 um")
              .otherwise(turns ? "1e-5 rad" : "1e-6 of the size of the model"));
    visit(base::field("stick", stick,
                      "by a stiff spring that breaks away at `slip` (`elastic`), without any "
                      "motion (`rigid`), or by LuGre's law of bending bristles (`bristles`)"));
    bristle_fields(visit, turns);
    visit(base::field("bearing-length", length,
                      "length over which bending moments are carried by a pair of opposite forces")
              .in(base::kLength)
              .positive()
              .like("40 mm")
              .otherwise("bending moments cause no friction"));
  }

 private:
  template <class Visitor>
  void bristle_fields(Visitor& visit, bool turns) {
    visit(base::field("bristle-stiffness", bristle_stiffness, "of `bristles`, sigma-0 of LuGre")
              .in(turns ? base::kRotationalStiffness : base::kStiffness)
              .positive()
              .like(turns ? "1e4 N m/rad" : "1e5 N/m")
              .otherwise("needed with `stick: bristles`"));
    visit(base::field("bristle-damping", bristle_damping, "of `bristles`, sigma-1 of LuGre")
              .in(turns ? base::kRotationalDamping : base::kDamping)
              .non_negative()
              .like(turns ? "10 N m s/rad" : "300 N s/m")
              .otherwise("none"));
    visit(base::field("elastic-share", elastic_share,
                      "share of the force that slides up to which bristles bend without slipping, "
                      "so that nothing creeps below; 0 is LuGre's own law, which creeps")
              .within(base::Range::fraction)
              .like("0.8"));
  }
};

struct HingeFrictionSpec : JointFrictionBase {
  static constexpr const char* kKey = "hinge-friction";
  static constexpr const char* kDoc =
      "dry friction against rotation, from the reaction of the joint; sticks without creep";
  static constexpr bool kTurns = true;
  double radius = 0;        ///< of the pin [m]
  double axial_radius = 0;  ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    joint_fields(visit, kTurns);
    law_fields(visit, kTurns);
    visit(base::field("radius", radius,
                      "radius of the pin, on which forces across the axis cause friction")
              .in(base::kLength)
              .non_negative()
              .like("8 mm"));
    visit(base::field("axial-radius", axial_radius,
                      "mean radius of the collar on which forces along the axis cause friction")
              .in(base::kLength)
              .non_negative()
              .like("12 mm"));
  }
};

struct BallFrictionSpec : JointFrictionBase {
  static constexpr const char* kKey = "ball-friction";
  static constexpr const char* kDoc =
      "dry friction against the rotations of a spherical joint, or about both arms of a universal "
      "one, from the reaction of the joint; sticks without creep";
  double radius = 0;  ///< of the ball, or of the pins of the cross [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("joint", joint, "name of a spherical or universal joint")
              .required()
              .like("ball"));
    law_fields(visit, true);
    visit(base::field("radius", radius, "radius of the ball, or of the pins of the cross")
              .in(base::kLength)
              .non_negative()
              .like("10 mm"));
  }
};

struct SlideFrictionSpec : JointFrictionBase {
  static constexpr const char* kKey = "slide-friction";
  static constexpr const char* kDoc =
      "dry friction against sliding, from the reaction of the joint; sticks without creep";
  static constexpr bool kTurns = false;
  std::optional<double> torque_radius;  ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    joint_fields(visit, kTurns);
    law_fields(visit, kTurns);
    visit(base::field("torque-radius", torque_radius,
                      "distance from the axis at which the torque about it is carried")
              .in(base::kLength)
              .positive()
              .like("15 mm")
              .otherwise("the torque about the axis causes no friction"));
  }
};

}  // namespace buckens::loads
