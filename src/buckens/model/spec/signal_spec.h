// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/coordinate_choice.h"
#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/signal_law.h"

namespace buckens::model {

/// Motion of a marker along a world direction.
struct MarkerSignalSpec {
  SourceLocation where;
  base::MarkerRef of;
  Eigen::Vector3d along = Eigen::Vector3d::Zero();

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("of", of, "marker").required().like("rod/end"));
    visit(base::field("along", along, "direction in world axes").required().like("[0, 1, 0]"));
  }
};

/// Common to all blocks.
struct BlockInput {
  SourceLocation where;
  base::SignalLaw input;

  template <class Visitor>
  void input_field(Visitor& visit) {
    visit(base::field("input", input, "formula of t and signals, or the name of one")
              .of_any_dimension()
              .required()
              .like("\"0.5 - angle\""));
  }
};

struct IntegralSpec : BlockInput {
  double start = 0;
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("start", start, "value at t = 0").of_any_dimension().like("0.2"));
  }
};

/// First-order lag: T ẋ + x = u.
struct LagSpec : BlockInput {
  double time_constant = 0;  ///< [s]
  double start = 0;
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("time-constant", time_constant, "T of T x' + x = input")
              .in(base::kTime)
              .required()
              .positive()
              .like("20 ms"));
    visit(base::field("start", start, "value at t = 0").of_any_dimension().like("0.2"));
  }
};

/// Rational transfer function in s, at rest at t = 0.
struct TransferFunctionSpec : BlockInput {
  std::vector<double> numerator, denominator;  ///< falling powers of s
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("numerator", numerator, "coefficients by falling powers of s")
              .of_any_dimension()
              .required()
              .like("[1]"));
    visit(base::field("denominator", denominator, "coefficients by falling powers of s")
              .of_any_dimension()
              .required()
              .like("[0.01, 0.2, 1]"));
  }
};

/// ẋ = A x + B u, y = C x + D u.
struct StateSpaceSpec : BlockInput {
  std::vector<std::vector<double>> A;
  std::vector<double> B, C, start;
  double D = 0;
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("A", A, "rows of the matrix of the states")
              .of_any_dimension()
              .required()
              .like("[[0, 1], [-100, -2]]"));
    visit(base::field("B", B, "how the input drives the states")
              .of_any_dimension()
              .required()
              .like("[0, 1]"));
    visit(base::field("C", C, "how the value is made of the states")
              .of_any_dimension()
              .required()
              .like("[100, 0]"));
    visit(base::field("D", D, "share of the input in the value").of_any_dimension().like("0"));
    visit(base::field("start", start, "states at t = 0")
              .of_any_dimension()
              .like("[0, 0]")
              .otherwise("all zero"));
  }
};

/// Proportional, integral and filtered derivative, with anti-windup.
struct PidSpec : BlockInput {
  double proportional = 0, integral = 0, derivative = 0;
  std::optional<double> filter;                 ///< [s]
  std::optional<std::array<double, 2>> limits;  ///< of the value
  std::optional<double> tracking;               ///< [s]
  std::optional<double> sample;                 ///< [s]

  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("proportional", proportional, "gain on the input")
              .of_any_dimension()
              .like("40"));
    visit(base::field("integral", integral, "gain on the integral of the input")
              .of_any_dimension()
              .like("10"));
    visit(base::field("derivative", derivative, "gain on the rate of the input")
              .of_any_dimension()
              .like("2"));
    visit(base::field("filter", filter,
                      "time constant of the derivative: D s/(1 + filter s); a sampled one may go "
                      "without")
              .in(base::kTime)
              .positive()
              .like("5 ms")
              .otherwise("needed with `derivative` unless sampled"));
    visit(base::field("limits", limits,
                      "least and largest value; beyond them the integral follows (anti-windup)")
              .of_any_dimension()
              .like("[-5, 5]")
              .otherwise("none"));
    visit(base::field("tracking-time", tracking,
                      "time in which the integral follows a value that is limited")
              .in(base::kTime)
              .positive()
              .like("50 ms")
              .otherwise("proportional/integral; a sampled one stops the integral at once"));
    visit(base::field("sample", sample, "time between two samples; the value is held between them")
              .in(base::kTime)
              .positive()
              .like("1 ms")
              .otherwise("continuous"));
  }
};

/// Sample and hold.
struct SampleHoldSpec : BlockInput {
  double sample = 0;  ///< [s]
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("sample", sample, "time between two samples")
              .in(base::kTime)
              .required()
              .positive()
              .like("1 ms"));
  }
};

/// A function of the input, given by points.
struct TableSignalSpec : BlockInput {
  std::vector<std::array<double, 2>> points;
  base::Interpolation interpolation = base::Interpolation::linear;
  base::Extrapolation extrapolation = base::Extrapolation::refuse;
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("points", points, "pairs of input and value, inputs increasing")
              .of_any_dimension()
              .required()
              .like("[[0, 0], [100, 8], [300, 10]]"));
    visit(base::field("interpolation", interpolation, "between the points"));
    visit(base::field("extrapolation", extrapolation,
                      "beyond the points: an error, or the first and last value"));
  }
};

/// Follows its input with limited rate: T ẋ = u − x within limits of ẋ.
struct RateLimitSpec : BlockInput {
  double rising = 0, falling = 0;  ///< largest rates upwards and downwards, both > 0 [1/s]
  double time_constant = 1e-3;     ///< [s]
  double start = 0;
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("rising", rising, "largest rate upwards, per second")
              .of_any_dimension()
              .required()
              .positive()
              .like("5"));
    visit(base::field("falling", falling, "largest rate downwards, per second, a positive number")
              .of_any_dimension()
              .required()
              .positive()
              .like("5"));
    visit(base::field("time-constant", time_constant, "of the lag that it is below these rates")
              .in(base::kTime)
              .positive()
              .like("1 ms")
              .otherwise("1 ms"));
    visit(base::field("start", start, "value at t = 0").of_any_dimension().like("0.2"));
  }
};

/// On or off, depending on the level of a signal, with hysteresis.
struct SwitchSpec : BlockInput {
  double on = 0;
  std::optional<double> off;
  bool start = false;
  template <class Visitor>
  void fields(Visitor& visit) {
    input_field(visit);
    visit(base::field("on", on, "level of the input at which the value becomes 1")
              .of_any_dimension()
              .required()
              .like("0.4"));
    visit(base::field("off", off,
                      "level at which it becomes 0 again; below `on` it switches on upwards, above "
                      "it downwards")
              .of_any_dimension()
              .like("0.3")
              .otherwise("it stays on"));
    visit(base::field("start", start, "whether it is on before the first step").on_off());
  }
};

/// A number that is constant until an event, or Python or C++ code between steps, sets it.
struct SettingSpec {
  double start = 0;
  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("start", start, "value until another is set")
              .of_any_dimension()
              .required()
              .shorthand()
              .like("0.2"));
  }
};

/// A coordinate of a joint.
struct JointSignalSpec {
  SourceLocation where;
  std::string joint;
  std::optional<base::CoordinateChoice> which;
  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("joint", joint, "name of the joint").required().shorthand().like("bead"));
    visit(base::field("which", which, "of joints with several coordinates")
              .like("x")
              .otherwise("the angle of joints that rotate, the displacement of those that slide; "
                         "needed where there are only others"));
  }
};

/// One value of a sensor of `output`.
struct SensorSignalSpec {
  SourceLocation where;
  std::string of;
  std::optional<std::string> component;
  double start = 0;
  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("of", of, "name of the sensor").required().shorthand().like("strut-force"));
    visit(base::field("component", component,
                      "which of its values: what follows the sensor's name in the heading of its "
                      "column of sensors.csv")
              .like("y")
              .otherwise("the only one"));
    visit(base::field("start", start,
                      "value before the first reading, of sensors that are read at the ends of "
                      "steps; all statics use it")
              .of_any_dimension()
              .like("0"));
  }
};

struct SignalSpec;

/// The joint quantity that a signal reads.
struct JointReading {
  const char* key;           ///< in the model file
  const std::string* joint;  ///< its name
  std::optional<base::CoordinateChoice> which;
  bool is_rate;
};
/// The given quantities, at most one.
std::vector<JointReading> joint_readings(const SignalSpec& spec);

/// A named number that varies with the motion: exactly one of the members is given.
struct SignalSpec {
  // In signal_spec.cpp, because they reach through all members: two to five seconds of compiling
  // each.
  SignalSpec();
  SignalSpec(const SignalSpec&);
  SignalSpec(SignalSpec&&) noexcept;
  SignalSpec& operator=(const SignalSpec&);
  SignalSpec& operator=(SignalSpec&&) noexcept;
  ~SignalSpec();

  std::string name;
  SourceLocation where;
  std::optional<base::SignalLaw> value;
  std::optional<std::string> joint_angle, joint_speed, joint_displacement, joint_velocity;
  std::optional<std::string> joint_second_angle, joint_second_speed;
  std::optional<JointSignalSpec> joint_coordinate, joint_rate;
  std::optional<MarkerSignalSpec> position, velocity;
  std::optional<std::string> force_of;
  std::optional<SensorSignalSpec> sensor;
  std::optional<IntegralSpec> integral;
  std::optional<LagSpec> lag;
  std::optional<TransferFunctionSpec> transfer_function;
  std::optional<StateSpaceSpec> state_space;
  std::optional<PidSpec> pid;
  std::optional<SampleHoldSpec> sample_hold;
  std::optional<TableSignalSpec> table;
  std::optional<RateLimitSpec> rate_limit;
  std::optional<SwitchSpec> switched;
  std::optional<SettingSpec> setting;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("value", value, "formula of t and signals")
              .of_any_dimension()
              .shorthand()
              .like("\"20*(0.5 - angle) - 3*speed\""));
    motion_fields(visit);
    visit(base::field("integral", integral,
                      "integral of a formula over time, which may name "
                      "itself: a state with its rate"));
    visit(base::field("lag", lag, "first-order lag"));
    visit(base::field("transfer-function", transfer_function,
                      "quotient of two polynomials in s, at rest at t = 0"));
    visit(base::field("state-space", state_space, "linear system with one input and one value"));
    visit(base::field("pid", pid, "controller with proportional, integral and derivative part"));
    visit(base::field("sample-hold", sample_hold, "sampled and held"));
    visit(base::field("table", table, "function of a formula by points"));
    visit(base::field("rate-limit", rate_limit, "follows a formula no faster than it may"));
    visit(base::field("switch", switched,
                      "1 or 0 by the level of a signal, from the end of the step in which it is "
                      "reached"));
    visit(base::field("setting", setting,
                      "a number that stays until an event changes it with `set`, or Python or C++ "
                      "between steps"));
  }

 private:
  template <class Visitor>
  void motion_fields(Visitor& visit) {
    visit(base::field("joint-angle", joint_angle, "angle of this joint from its position as placed")
              .like("elbow"));
    visit(base::field("joint-speed", joint_speed, "rate of the angle of this joint").like("elbow"));
    visit(base::field("joint-second-angle", joint_second_angle,
                      "angle of this universal joint about the arm that its second body holds")
              .like("cross"));
    visit(base::field("joint-second-speed", joint_second_speed, "rate of this second angle")
              .like("cross"));
    visit(base::field("joint-displacement", joint_displacement,
                      "displacement of this joint from its position as placed")
              .like("slider"));
    visit(base::field("joint-velocity", joint_velocity, "rate of the displacement of this joint")
              .like("slider"));
    visit(base::field("joint-coordinate", joint_coordinate,
                      "any coordinate of a joint from its position as placed, such as the swing of "
                      "a ball joint"));
    visit(base::field("joint-rate", joint_rate, "rate of any coordinate of a joint"));
    visit(base::field("position", position, "position of a marker along a direction of the world"));
    visit(base::field("velocity", velocity, "velocity of a marker along a direction of the world"));
    visit(base::field("force-of", force_of,
                      "force or torque of this load along the coordinate of its joint, as it "
                      "drives it")
              .like("motor"));
    visit(
        base::field("sensor", sensor,
                    "a value of a sensor. Within the step, without delay: `position`, `velocity`, "
                    "`angular-velocity`, `relative` but for its `angle`, `joint-coordinate`, "
                    "`spring-force`, `spring-torque`, `joint-force` and `joint-torque` of "
                    "bushings, `contact` of an elastic one. Of all others, which hang on "
                    "reactions, accelerations or what happened before, the value at the end of "
                    "the last step, held over the next"));
  }
};

}  // namespace buckens::model
