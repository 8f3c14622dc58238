// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "buckens/base/characteristic.h"
#include "buckens/base/motion_dimensions.h"
#include "buckens/base/signal_law.h"
#include "buckens/joints/coordinate_drive_spec.h"
#include "buckens/joints/coupler_spec.h"
#include "buckens/joints/coupling_specs.h"
#include "buckens/joints/drive_laws.h"
#include "buckens/joints/guide_specs.h"
#include "buckens/joints/joint_ends.h"
#include "buckens/joints/meshing_specs.h"
#include "buckens/joints/slot_spec.h"
#include "buckens/joints/travel_specs.h"

namespace buckens::joints {

struct RevoluteSpec : JointEndsAndAxis {
  static constexpr const char* kKey = "revolute";
  static constexpr const char* kDoc = "hinge: only rotation about the axis is free";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle};
  template <class Visitor>
  void fields(Visitor& visit) {
    axis_fields(visit);
  }
};

struct SphericalSpec : JointEnds {
  static constexpr const char* kKey = "spherical";
  static constexpr const char* kDoc =
      "ball joint: all rotations are free; its coordinates are the `swing`, the angle between an "
      "axis that the first body holds and one that the second holds, which has no direction where "
      "it is 0 (a spring on it should be free of torque there), and the `twist` of the second body "
      "about its axis beside the shortest turn from the one to the other";
  static constexpr std::array kCoordinates{base::CoordinateChoice::swing,
                                           base::CoordinateChoice::twist};
  std::optional<Eigen::Vector3d> held_axis;   ///< in the first marker
  std::optional<Eigen::Vector3d> moved_axis;  ///< in the first marker, as placed
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("axis", held_axis,
                      "of `swing` and `twist`: the axis that the first body holds, in the first "
                      "marker's axes")
              .like("[0, 0, 1]")
              .otherwise("the first marker's z axis"));
    visit(base::field("second-axis", moved_axis,
                      "of `swing` and `twist`: the axis that the second body holds, as placed, in "
                      "the first marker's axes")
              .like("[0, 1, 2]")
              .otherwise("that of `axis`"));
  }
};

struct PrismaticSpec : JointEnds {
  static constexpr const char* kKey = "prismatic";
  static constexpr const char* kDoc = "slider: only translation along the axis is free";
  static constexpr std::array kCoordinates{base::CoordinateChoice::displacement};
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< in the first marker
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("axis", axis, "direction of sliding in the first marker's axes")
              .required()
              .like("[1, 0, 0]"));
  }
};

struct FixedSpec : JointEnds {
  static constexpr const char* kKey = "fixed";
  static constexpr const char* kDoc = "weld: no relative motion of the markers";
  bool as_found = false;
  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("as-found", as_found,
                      "whether an event that attaches it holds the markers as they are then, "
                      "however far apart and turned, as a gripper does")
              .on_off());
  }
};

/// Elastic connection along and about the axes of the first marker, force-free as placed.
struct BushingSpec : JointEnds {
  static constexpr const char* kKey = "bushing";
  static constexpr const char* kDoc =
      "elastic connection with stiffness and damping along and "
      "about the three axes of the first marker";
  static constexpr const char* kInstead =
      "its springs are fields of its own; observe its motion by `relative`";
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();             ///< [N/m]
  Eigen::Vector3d rotational_stiffness = Eigen::Vector3d::Zero();  ///< [N m/rad]
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();               ///< [N s/m]
  Eigen::Vector3d rotational_damping = Eigen::Vector3d::Zero();    ///< [N m s/rad]
  /// Additional laws along and about each axis [N], [N m].
  std::array<std::optional<base::Characteristic>, 3> forces, torques;
  base::SignalLaw stiffness_factor = 1.0, damping_factor = 1.0;

  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("stiffness", stiffness, "along the axes")
              .in(base::kStiffness)
              .non_negative()
              .like("[1e6 N/m, 1e6 N/m, 1e5 N/m]"));
    visit(base::field("rotational-stiffness", rotational_stiffness, "about the axes")
              .in(base::kRotationalStiffness)
              .non_negative()
              .like("[0, 0, 20 N m/rad]"));
    visit(base::field("damping", damping, "along the axes")
              .in(base::kDamping)
              .non_negative()
              .like("[100 N s/m, 100 N s/m, 0]"));
    visit(base::field("rotational-damping", rotational_damping, "about the axes")
              .in(base::kRotationalDamping)
              .non_negative()
              .like("[0, 0, 0.1 N m s/rad]"));
    visit(base::field("stiffness-factor", stiffness_factor,
                      "multiplies what it resists with at rest, about and along all axes; by time "
                      "and signals")
              .non_negative()
              .like("\"1 + 2*mode\"")
              .otherwise("1"));
    visit(base::field("damping-factor", damping_factor,
                      "multiplies what it resists with against motion beyond that; by time and "
                      "signals")
              .non_negative()
              .like("\"1 + 9*mode\"")
              .otherwise("1"));
    curve_fields(visit);
  }

 private:
  template <class Visitor>
  void curve_fields(Visitor& visit) {
    static constexpr const char* kForces[] = {"force-x", "force-y", "force-z"};
    static constexpr const char* kTorques[] = {"torque-x", "torque-y", "torque-z"};
    for (std::size_t k = 0; k < 3; ++k) {
      visit(base::field(kForces[k], forces[k],
                        "force against the displacement along this axis as a formula in "
                        "`displacement` and `rate`, or a table of the displacement in m; added to "
                        "stiffness and damping")
                .in(base::kForce)
                .like("\"2e9*displacement^3 N\"")
                .otherwise("none"));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      visit(base::field(kTorques[k], torques[k],
                        "torque against the turn about this axis as a formula in `angle` and "
                        "`rate`, or a table of the angle in rad; added to stiffness and damping")
                .in(base::kTorque)
                .like("\"300*angle^3 N m\"")
                .otherwise("none"));
    }
  }
};

struct PrescribedRotationSpec : JointEndsAndAxis {
  static constexpr const char* kKey = "prescribed-rotation";
  static constexpr const char* kDoc =
      "drives the rotation about the axis; add a joint for the other directions. Between the "
      "markers of a universal joint, about the arm that the first of them holds, it drives the "
      "angle of that arm";
  static constexpr std::array kCoordinates{base::CoordinateChoice::angle};
  // Exactly one of the three is given.
  std::optional<base::SignalLaw> angle;         ///< counted from the position as placed [rad]
  std::optional<base::SignalLaw> speed;         ///< [rad/s]; the angle is its integral from t = 0
  std::optional<base::SignalLaw> acceleration;  ///< [rad/s²]; the speed is its integral from t = 0

  DriveLaws laws() const { return {angle, speed, acceleration}; }

  template <class Visitor>
  void fields(Visitor& visit) {
    axis_fields(visit);
    visit(base::field(
              "angle", angle,
              "angle of the second marker about the axis, measured from the position as placed; a "
              "formula of t and signals whose rate has no jumps: "
              "of states of blocks, no measured angles or speeds")
              .in(base::kAngle)
              .like("\"150*t\"")
              .otherwise("give this or `speed`"));
    visit(base::field("speed", speed,
                      "angular velocity of the second marker about the axis; the angle is its "
                      "integral from t = 0 and starts from the position as placed; a formula of t "
                      "and signals, but of measured speeds and forces only behind a `lag` or an "
                      "`integral`")
              .in(base::kAngularVelocity)
              .like("3000 rpm")
              .otherwise("give this or `angle`"));
    visit(
        base::field("acceleration", acceleration,
                    "angular acceleration of the second marker about the axis, a formula of t and "
                    "signals; it begins at rest at the position as placed")
            .in(base::kAngularAcceleration)
            .like("\"20*sin(5*t) rad/s^2\"")
            .otherwise("give this, `angle` or `speed`"));
  }
};

struct PrescribedTranslationSpec : JointEnds {
  static constexpr const char* kKey = "prescribed-translation";
  static constexpr const char* kDoc =
      "drives the displacement along the axis; add a joint for the other directions";
  static constexpr std::array kCoordinates{base::CoordinateChoice::displacement};
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< in the first marker
  // Exactly one of the three is given.
  std::optional<base::SignalLaw> displacement;  ///< counted from the position as placed [m]
  std::optional<base::SignalLaw> velocity;      ///< [m/s]; the displacement is its integral
  std::optional<base::SignalLaw> acceleration;  ///< [m/s²]; the velocity is its integral

  DriveLaws laws() const { return {displacement, velocity, acceleration}; }

  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("axis", axis, "direction in the first marker's axes")
              .required()
              .like("[1, 0, 0]"));
    visit(base::field("displacement", displacement,
                      "displacement of the second marker along the axis, measured from the "
                      "position as placed; a formula of t and signals whose rate has no jumps: of "
                      "states of blocks, no measured places or velocities")
              .in(base::kLength)
              .like("\"10*sin(20*t) mm\"")
              .otherwise("give this, `velocity` or `acceleration`"));
    visit(base::field("velocity", velocity,
                      "of the second marker along the axis; the displacement is its integral from "
                      "t = 0 and begins at the position as placed; a formula of t and signals, but "
                      "of measured velocities and forces only behind a `lag` or an `integral`")
              .in(base::kVelocity)
              .like("0.2 m/s")
              .otherwise("give this or `displacement`"));
    visit(
        base::field("acceleration", acceleration,
                    "of the second marker along the axis, a formula of t and signals; it begins at "
                    "rest at the position as placed")
            .in(base::kAcceleration)
            .like("\"2*sin(5*t) m/s^2\"")
            .otherwise("give this or `displacement`"));
  }
};

/// A connection between two markers.
struct JointSpec {
  std::string name;
  SourceLocation where;
  std::variant<RevoluteSpec, SphericalSpec, PrismaticSpec, FixedSpec, BushingSpec,
               PrescribedRotationSpec, PrescribedTranslationSpec, CylindricalSpec, PlanarJointSpec,
               UniversalSpec, ConstantVelocitySpec, PointOnLineSpec, PointInPlaneSpec, ParallelSpec,
               OrientationSpec, DistanceSpec, ScrewSpec, GearSpec, RackSpec, BeltSpec, SlotSpec,
               CouplerSpec, SliderOnBeamSpec, RollingSpec, PrescribedCoordinateSpec>
      kind;

  /// Key of the kind in the model file.
  const char* kind_name() const {
    return std::visit([]<class T>(const T&) { return T::kKey; }, kind);
  }
  /// The coordinates of the joint, in order.
  std::span<const base::CoordinateChoice> coordinates() const {
    return std::visit(
        []<class T>(const T&) -> std::span<const base::CoordinateChoice> {
          if constexpr (requires { T::kCoordinates; }) return T::kCoordinates;
          return {};
        },
        kind);
  }
  /// For a kind without coordinates, an alternative; otherwise null.
  const char* instead() const {
    return std::visit(
        []<class T>(const T&) -> const char* {
          if constexpr (requires { T::kInstead; }) return T::kInstead;
          return nullptr;
        },
        kind);
  }
  /// The laws that drive it; most kinds have none.
  DriveLaws laws() const {
    static const std::optional<base::SignalLaw> kNone;
    return std::visit(
        []<class T>(const T& spec) -> DriveLaws {
          if constexpr (requires { spec.laws(); }) return spec.laws();
          return {kNone, kNone, kNone};
        },
        kind);
  }
  /// Whether the driven quantity is an angle.
  bool drives_angle() const {
    if (const auto* drive = std::get_if<PrescribedCoordinateSpec>(&kind)) {
      return drive->drives_angle();
    }
    return std::holds_alternative<PrescribedRotationSpec>(kind);
  }
  /// Whether it has a coordinate.
  bool has(base::CoordinateChoice which) const {
    return base::meant(coordinates(), which, base::CoordinateSort::any).has_value();
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(kind, "kind of the joint").required());
  }
};

}  // namespace buckens::joints
