// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/spec_findings.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/contact_findings.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/marker_names.h"

namespace buckens::model {

Found needed_axis_problem(const std::optional<Eigen::Vector3d>& axis,
                          const ModelDescription& model) {
  if (axis) return axis_problem(*axis);
  if (model.planar) return std::nullopt;
  return Finding{"axis",
                 "the key \"axis\" is missing; a model in space needs it, for example "
                 "axis: [0, 0, 1]"};
}

namespace {

constexpr double kMostSteps = 1e10;
constexpr int kMostKeptSolves = 1000;
// Third differences of positions contain a few times their rounding.
constexpr double kLeastTolerance = 1e-13;
constexpr int kMostStaticPoints = 1000000;

/// Springs and sensors may connect two markers of one flexible body, joints may not.
Found ends_problem(const std::array<base::MarkerRef, 2>& between, bool is_joint) {
  const bool is_same =
      is_joint ? between[0].body == between[1].body : text_of(between[0]) == text_of(between[1]);
  if (!is_same) return std::nullopt;
  return Finding{"between", fmt::format("\"{}\" and \"{}\" are {}; two different bodies are needed",
                                        text_of(between[0]), text_of(between[1]),
                                        is_joint ? "on the same body" : "the same marker")};
}

Found flexible_problem(const base::MarkerRef& marker, const char* key,
                       const ModelDescription& model) {
  const body::BodySpec* body = base::find_named(model.bodies, marker.body);
  if (body != nullptr && !body->is_rigid()) return std::nullopt;
  return Finding{key, fmt::format("\"{}\" is not on a flexible body", text_of(marker))};
}

/// A deflection is seen from markers of the same body.
Found other_body_problem(const DeflectionSensor& spec, const base::MarkerRef& marker,
                         const char* key) {
  if (marker.body == spec.of.body && text_of(marker) != text_of(spec.of)) return std::nullopt;
  return Finding{
      key, marker.body == spec.of.body
               ? fmt::format("\"{}\" is the observed marker itself; name another", text_of(marker))
               : fmt::format("\"{}\" is not on body \"{}\", whose deformation is observed; use a "
                             "`relative` sensor between two bodies",
                             text_of(marker), spec.of.body)};
}

/// A chord runs between two named ends.
Found deflection_problem(const DeflectionSensor& spec, const ModelDescription& model) {
  if (Found found = flexible_problem(spec.of, "of", model)) return found;
  if (spec.chord && !(spec.from == DeflectionBase::chord)) {
    return Finding{"chord", "it belongs to `from: chord`; remove one of them"};
  }
  if (spec.from == DeflectionBase::other) {
    return other_body_problem(spec, spec.from.marker, "from");
  }
  if (spec.from == DeflectionBase::frame) return std::nullopt;
  if (spec.chord) {
    for (const base::MarkerRef& end : *spec.chord) {
      if (Found found = other_body_problem(spec, end, "chord")) return found;
    }
    return ends_problem(*spec.chord, false);
  }
  const auto names = marker_names(*base::find_named(model.bodies, spec.of.body));
  for (const char* end : {"start", "end"}) {
    if (std::find(names.begin(), names.end(), end) != names.end()) continue;
    return Finding{
        "from", fmt::format("body \"{}\" has no marker \"{}\", and the chord runs from `start` to "
                            "`end` by default; name its ends with `chord`, or write `from: frame`",
                            spec.of.body, end)};
  }
  return std::nullopt;
}

/// Springs are found among the loads, bushings among the joints.
Found spring_problem(const std::string& name, bool torque, const ModelDescription& model) {
  std::vector<std::string> known;
  for (const loads::LoadSpec& load : model.loads) {
    const bool has_it = torque ? std::holds_alternative<loads::TorsionalSpringSpec>(load.kind) ||
                                     std::holds_alternative<loads::BallFrictionSpec>(load.kind)
                               : std::holds_alternative<loads::SpringDamperSpec>(load.kind) ||
                                     std::holds_alternative<loads::RopeSpec>(load.kind) ||
                                     std::holds_alternative<loads::CamSpec>(load.kind);
    if (has_it || acts_on_coordinate(load, torque)) known.push_back(load.name);
  }
  for (const joints::JointSpec& joint : model.joints) {
    if (std::holds_alternative<joints::BushingSpec>(joint.kind)) known.push_back(joint.name);
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return std::nullopt;
  const char* what = torque ? "torsional-spring or bushing" : "spring-damper or bushing";
  return Finding{"spring", fmt::format("there is no {} \"{}\".{}", what, name,
                                       known.empty() ? " The model has none."
                                                     : base::suggestion(name, known))};
}

/// A rotation is driven by its angle, its speed or its acceleration.
Found drive_problem(const joints::PrescribedRotationSpec& spec) {
  if (spec.laws().num_given() == 1) return std::nullopt;
  return Finding{spec.angle && spec.speed ? "speed" : "",
                 "exactly one of the keys angle, speed and acceleration is needed, for example "
                 "angle: \"150*t\" or speed: 1500 rpm"};
}

Found drive_problem(const joints::PrescribedTranslationSpec& spec) {
  if (spec.laws().num_given() != 1) {
    return Finding{"",
                   "exactly one of the keys displacement, velocity and acceleration is needed, "
                   "for example displacement: \"10*sin(20*t) mm\" or velocity: 0.2 m/s"};
  }
  return axis_problem(spec.axis);
}

/// Rules of the alternatives; overloads for those that have any.
struct AlternativeRules {
  const ModelDescription& model;
  bool is_joint = false;

  template <class T>
  Found operator()(const T& spec) const {
    if constexpr (requires { spec.between; }) {
      if (Found found = ends_problem(spec.between, is_joint)) return found;
    }
    if constexpr (std::is_same_v<T, SignalSensor>) {
      if (base::find_named(model.signals, spec.signal) != nullptr) return std::nullopt;
      return Finding{"signal", fmt::format("unknown signal \"{}\".{}", spec.signal,
                                           base::suggestion(spec.signal, names_of(model.signals)))};
    } else if constexpr (requires { own_joint_problem(spec, model); }) {
      return own_joint_problem(spec, model);
    } else if constexpr (std::is_same_v<T, RelativeSensor>) {
      return spec.quantity == RelativeQuantity::angle ? needed_axis_problem(spec.axis, model)
                                                      : std::nullopt;
    } else if constexpr (std::is_same_v<T, joints::PrescribedRotationSpec>) {
      if (Found found = drive_problem(spec)) return found;
      return needed_axis_problem(spec.axis, model);
    } else if constexpr (std::is_same_v<T, joints::PrescribedTranslationSpec>) {
      return drive_problem(spec);
    } else if constexpr (requires { spec.axis.has_value(); }) {
      return needed_axis_problem(spec.axis, model);
    } else if constexpr (requires { spec.axis.norm(); }) {
      return axis_problem(spec.axis);
    } else if constexpr (requires { spec.along; }) {
      if (!spec.along || spec.along->norm() > 0.0) return std::nullopt;
      return Finding{"along", "[0, 0, 0] is not a direction; give for example [0, -1, 0]"};
    } else if constexpr (std::is_same_v<T, loads::BodyForceSpec>) {
      if (spec.per_mass.has_value() != spec.per_volume.has_value()) return std::nullopt;
      return Finding{"", "exactly one of the keys per-mass and per-volume is needed"};
    } else if constexpr (requires { spec.on.is_ground(); }) {
      if (!spec.on.is_ground()) return std::nullopt;
      return Finding{"on", "a load on the ground has no effect; name a body"};
    } else if constexpr (requires { spec.joint; }) {
      return joint_force_problem(spec.joint, model);
    } else if constexpr (requires { spec.spring; }) {
      return spring_problem(spec.spring, std::is_same_v<T, SpringTorqueSensor>, model);
    } else if constexpr (requires { spec.load; }) {
      if (base::find_named(model.loads, spec.load) != nullptr) return std::nullopt;
      const auto known = names_of(model.loads);
      return Finding{"load", fmt::format("unknown load \"{}\".{}", spec.load,
                                         base::suggestion(spec.load, known))};
    } else if constexpr (std::is_same_v<T, DeflectionSensor>) {
      return deflection_problem(spec, model);
    } else if constexpr (requires { spec.element; }) {
      return flexible_problem(spec.of, "of", model);
    } else {
      return std::nullopt;
    }
  }
};

template <class Variant>
Found alternative_problem(const Variant& kind, const ModelDescription& model,
                          bool is_joint = false) {
  const AlternativeRules rules{model, is_joint};
  return std::visit([&]<class T>(const T& spec) { return under(T::kKey, rules(spec)); }, kind);
}

}  // namespace

Found axis_problem(const Eigen::Vector3d& axis) {
  if (axis.norm() > 0.0) return std::nullopt;
  return Finding{"axis", "an axis cannot be [0, 0, 0]; give its direction"};
}

Found problem(const joints::JointSpec& spec, const ModelDescription& model) {
  return alternative_problem(spec.kind, model, true);
}

Found problem(const loads::LoadSpec& spec, const ModelDescription& model) {
  return alternative_problem(spec.kind, model);
}

Found problem(const SensorSpec& spec, const ModelDescription& model) {
  return alternative_problem(spec.kind, model);
}

namespace {

/// Parameters of a method other than the chosen one, and values it cannot work with.
Found method_problem(const SimulationSpec& spec) {
  const char* chosen = choice_names(IntegrationMethod{})[static_cast<std::size_t>(spec.method)];
  if (spec.alpha && spec.method != IntegrationMethod::hht) {
    return Finding{
        "alpha",
        fmt::format("`alpha` belongs to `method: hht`; {} does not use it. Remove one of them",
                    chosen)};
  }
  if (spec.theta && spec.method != IntegrationMethod::wilson) {
    return Finding{
        "theta",
        fmt::format("`theta` belongs to `method: wilson`; {} does not use it. Remove one of them",
                    chosen)};
  }
  if (spec.alpha && !(*spec.alpha >= -1.0 / 3.0 && *spec.alpha <= 0.0)) {
    return Finding{"alpha",
                   fmt::format("alpha must lie between -1/3 and 0, not {}: outside this range the "
                               "method is unstable or loses its order; -0.1 is usual",
                               *spec.alpha)};
  }
  if (spec.theta && !(*spec.theta >= 1.366 && *spec.theta <= 10.0)) {
    return Finding{
        "theta",
        fmt::format(
            "theta must be at least 1.366 (and at most 10), not {}: below this value Wilson's "
            "method amplifies vibrations that the step does not resolve; 1.4 is usual",
            *spec.theta)};
  }
  return std::nullopt;
}

}  // namespace

Found problem(const SimulationSpec& spec, const ModelDescription&) {
  if (Found found = method_problem(spec)) return found;
  if (spec.tolerance && *spec.tolerance > 0.1) {
    return Finding{"tolerance",
                   fmt::format("an error of {:g} would swamp the motion; 1e-4 is coarse, 1e-6 fine",
                               *spec.tolerance)};
  }
  if (spec.tolerance && *spec.tolerance < kLeastTolerance) {
    return Finding{"tolerance", fmt::format("an error of {:g} per step is below the rounding error "
                                            "of positions; give at least {:g}",
                                            *spec.tolerance, kLeastTolerance)};
  }
  if (spec.kept_solves > kMostKeptSolves) {
    return Finding{"kept-solves", fmt::format("{} solutions would cost more to keep than they save "
                                              "in solves; keep at most {}, or omit the key for 80",
                                              spec.kept_solves, kMostKeptSolves)};
  }
  if (!spec.step && !spec.tolerance) {
    return Finding{"step",
                   "the key \"step\" is missing; add it, for example step: 0.1 ms or step: auto"};
  }
  const double step = spec.step.value_or(0.0);
  if (step == 0.0) return std::nullopt;
  if (step > spec.duration) {
    return Finding{"step", fmt::format("the step of {:g} s is longer than the duration of {:g} s",
                                       step, spec.duration)};
  }
  if (spec.duration / step > kMostSteps) {
    return Finding{
        "step",
        fmt::format("{:.3g} steps exceed the range of the step counter; choose a longer step",
                    spec.duration / step)};
  }
  return std::nullopt;
}

Found problem(const StaticSpec& spec, const ModelDescription&) {
  const double first = spec.load_factor[0];
  const double last = spec.load_factor[1];
  if (first == last) {
    return Finding{"load-factor", fmt::format("the first and last load factors are both {:g}; give "
                                              "two different ones, for example [0, 1]",
                                              first)};
  }
  if (spec.steps > kMostStaticPoints || spec.max_points > kMostStaticPoints) {
    return Finding{spec.steps > kMostStaticPoints ? "steps" : "max-points",
                   fmt::format("a path may have at most {} points", kMostStaticPoints)};
  }
  return std::nullopt;
}

Found problem(const ModelDescription& spec, const ModelDescription&) {
  if (spec.format != 1) {
    return Finding{"buckens", fmt::format("this program reads format 1, not {}", spec.format)};
  }
  if (spec.bodies.empty()) return Finding{"bodies", "a model needs at least one body"};
  if (spec.planar && spec.gravity.dot(spatial::normal(*spec.planar)) != 0.0) {
    return Finding{"gravity",
                   "gravity of a planar model must lie in its plane; set the component "
                   "normal to it to zero"};
  }
  if (Found found = coupled_joints_problem(spec)) return found;
  return stops_problem(spec);
}

}  // namespace buckens::model
