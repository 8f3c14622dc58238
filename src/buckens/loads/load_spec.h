// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "buckens/base/characteristic.h"
#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/signal_law.h"
#include "buckens/base/time_law.h"
#include "buckens/loads/belt_spec.h"
#include "buckens/loads/cable_spec.h"
#include "buckens/loads/cam_spec.h"
#include "buckens/loads/contact_spec.h"
#include "buckens/loads/distributed_load_spec.h"
#include "buckens/loads/elastic_gear_spec.h"
#include "buckens/loads/joint_law_spec.h"
#include "buckens/loads/load_axes.h"
#include "buckens/loads/load_fields.h"
#include "buckens/loads/motor_spec.h"
#include "buckens/loads/rope_spec.h"

namespace buckens::loads {

struct ForceSpec {
  static constexpr const char* kKey = "force";
  static constexpr const char* kDoc = "force on a marker";
  base::MarkerRef on;
  std::array<base::TimeLaw, 3> value;  ///< [N]
  LoadAxes axes = LoadAxes::fixed;
  std::string factor;  ///< name of a signal; empty: none

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("on", on, "marker on which the force acts").required().like("rod/end"));
    visit(components_field("value", value, base::kForce, "[0, \"10*sin(20*t) N\", 0]").required());
    visit(axes_field(axes, "marker"));
    visit(factor_field(factor));
  }
};

struct TorqueSpec {
  static constexpr const char* kKey = "torque";
  static constexpr const char* kDoc = "torque on a marker";
  base::MarkerRef on;
  std::array<base::TimeLaw, 3> value;  ///< [N m]
  LoadAxes axes = LoadAxes::fixed;
  std::string factor;  ///< name of a signal; empty: none

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("on", on, "marker on which the torque acts").required().like("crank"));
    visit(components_field("value", value, base::kTorque, "[0, 0, 2 N m]").required());
    visit(axes_field(axes, "marker"));
    visit(factor_field(factor));
  }
};

/// Tension k (l − l0) + c l̇ + f(t) along the line between two markers.
struct SpringDamperSpec {
  static constexpr const char* kKey = "spring-damper";
  static constexpr const char* kDoc = "spring and damper along the line between two markers";
  std::array<base::MarkerRef, 2> between;
  base::SignalLaw stiffness;              ///< k [N/m]
  base::SignalLaw damping;                ///< c [N s/m]
  std::optional<base::SignalLaw> length;  ///< l0 [m]; default: the distance as placed
  std::optional<base::SignalLaw> force;   ///< f [N], positive pulls the markers together
  std::optional<base::Characteristic> characteristic;  ///< [N] by elongation and its rate

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two markers").required().like("[ground, rod/end]"));
    visit(base::field("stiffness", stiffness, "spring rate, by time and signals")
              .in(base::kStiffness)
              .non_negative()
              .like("2 kN/m"));
    visit(base::field("damping", damping, "damper rate, by time and signals")
              .in(base::kDamping)
              .non_negative()
              .like("5 N s/m"));
    visit(base::field("length", length,
                      "length at which the spring is force-free, by time and signals")
              .in(base::kLength)
              .non_negative()
              .like("120 mm")
              .otherwise("the distance as placed"));
    visit(base::field("force", force,
                      "additional tension, by time and signals; positive pulls the markers "
                      "together")
              .in(base::kForce)
              .like("\"10*sin(20*t) N\"")
              .otherwise("none"));
    visit(base::field("characteristic", characteristic,
                      "tension as a formula in `displacement` (from the force-free length) and "
                      "`rate`, or a table of the elongation in m; added to spring and damper")
              .in(base::kForce)
              .like("\"2e6*displacement^3 N\"")
              .otherwise("none"));
  }
};

struct TorsionalSpringSpec {
  static constexpr const char* kKey = "torsional-spring";
  static constexpr const char* kDoc =
      "torsional spring and damper about an axis, for angles up to 3 rad either way";
  std::array<base::MarkerRef, 2> between;
  std::optional<Eigen::Vector3d> axis;  ///< in the first marker; default for planar: the normal
  base::SignalLaw stiffness;            ///< [N m/rad]
  base::SignalLaw damping;              ///< [N m s/rad]
  base::SignalLaw angle;                ///< free angle, from the position as placed [rad]
  std::optional<base::Characteristic> characteristic;  ///< [N m] by angle and rate

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two markers").required().like("[ground, arm]"));
    visit(base::field("axis", axis, "axis in the first marker's axes")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
    visit(base::field("stiffness", stiffness, "spring rate, by time and signals")
              .in(base::kRotationalStiffness)
              .non_negative()
              .like("20 N m/rad"));
    visit(base::field("damping", damping, "damper rate, by time and signals")
              .in(base::kRotationalDamping)
              .non_negative()
              .like("0.1 N m s/rad"));
    visit(base::field(
              "angle", angle,
              "angle at which the spring is torque-free, measured from the position as placed; by "
              "time and signals")
              .in(base::kAngle)
              .like("10 deg"));
    visit(base::field("characteristic", characteristic,
                      "torque as a formula in `angle` (from that free of torque) and `rate`, or a "
                      "table of the angle in rad; added to spring and damper")
              .in(base::kTorque)
              .like("\"300*angle^3 N m\"")
              .otherwise("none"));
  }
};

struct LoadSpec {
  std::string name;
  SourceLocation where;
  std::variant<ForceSpec, TorqueSpec, SpringDamperSpec, TorsionalSpringSpec, PressureSpec,
               TractionSpec, LineLoadSpec, BodyForceSpec, BaseAccelerationSpec, HingeSpringSpec,
               SlideSpringSpec, HingeStopSpec, SlideStopSpec, HingeFrictionSpec, SlideFrictionSpec,
               RopeSpec, HingeMotorSpec, SlideMotorSpec, BallFrictionSpec, HingeBrakeSpec,
               SlideBrakeSpec, ContactSpec, ContactsSpec, ElasticBeltSpec, CableSpec,
               ElasticGearSpec, CamSpec>
      kind;

  /// Key of the kind in the model file.
  const char* kind_name() const {
    return std::visit([]<class T>(const T&) { return T::kKey; }, kind);
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(kind, "kind of the load").required());
  }
};

}  // namespace buckens::loads
