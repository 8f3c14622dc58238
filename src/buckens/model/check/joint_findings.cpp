// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/joint_findings.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/give_findings.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

/// Whether a load is a law on the angle (or the displacement) of a joint.
bool acts_on_coordinate(const loads::LoadSpec& load, bool turns) {
  return std::visit(
      [&]<class T>(const T&) {
        if constexpr (requires { T::kTurns; }) return T::kTurns == turns;
        return false;
      },
      load.kind);
}

bool has_play(const joints::JointSpec& joint) {
  return std::visit(
      []<class T>(const T& kind) {
        if constexpr (requires { kind.backlash; }) return kind.backlash > 0.0;
        return false;
      },
      joint.kind);
}

/// Users look for the force of a spring at a joint sensor, too.
Found joint_problem(const std::string& name, const ModelDescription& model) {
  if (base::find_named(model.joints, name) != nullptr) return std::nullopt;
  if (const auto* load = base::find_named(model.loads, name)) {
    const bool turns = std::holds_alternative<loads::TorsionalSpringSpec>(load->kind) ||
                       acts_on_coordinate(*load, true);
    const bool is_spring = turns || std::holds_alternative<loads::SpringDamperSpec>(load->kind) ||
                           std::holds_alternative<loads::RopeSpec>(load->kind) ||
                           std::holds_alternative<loads::CamSpec>(load->kind) ||
                           acts_on_coordinate(*load, false);
    return Finding{"joint", fmt::format("\"{}\" is a load, not a joint; observe its `{}`", name,
                                        turns       ? "spring-torque"
                                        : is_spring ? "spring-force"
                                                    : "load-force")};
  }
  return Finding{"joint", fmt::format("unknown joint \"{}\".{}", name,
                                      base::suggestion(name, names_of(model.joints)))};
}

Found joint_force_problem(const std::string& name, const ModelDescription& model) {
  if (Found found = joint_problem(name, model)) return found;
  if (!has_play(*base::find_named(model.joints, name))) return std::nullopt;
  return Finding{"joint", fmt::format("\"{}\" has `backlash`, so its flanks are either in contact "
                                      "or apart; observe their force by `{{gear: {}}}`",
                                      name, name)};
}

namespace {

/// The coordinate of a joint on which a law acts.
template <class Law>
Found law_problem(const Law& law, const ModelDescription& model) {
  return coordinate_problem(
      {law.joint, law.which,
       Law::kTurns ? base::CoordinateSort::angles : base::CoordinateSort::displacements},
      model);
}

Found stop_problem(const loads::JointStop& spec, const char* unit) {
  if (!spec.from && !spec.to) {
    return Finding{
        "", "at least one of the keys from and to is needed: without them the stop has no limit"};
  }
  if (spec.from && spec.to && *spec.from >= *spec.to) {
    return Finding{
        "to",
        fmt::format("the free range ends at {:g} {} before it begins at {:g} {}; swap from and to",
                    *spec.to, unit, *spec.from, unit)};
  }
  if (Found found = give_problem(spec)) return found;
  return std::nullopt;
}

bool rolls(const joints::JointSpec& joint) {
  return std::holds_alternative<joints::RollingSpec>(joint.kind);
}

/// A number behind its key; nothing of a formula.
std::string shown(const base::SignalLaw& law) {
  const std::optional<double> number = law.number();
  return number ? fmt::format(": {:g}", *number) : "";
}

Found friction_problem(const loads::JointFrictionBase& spec) {
  const std::optional<double> sticking = spec.coefficient.number();
  const std::optional<double> sliding = spec.dynamic ? spec.dynamic->number() : std::nullopt;
  if (sliding && sticking && *sliding > *sticking) {
    return Finding{"dynamic", fmt::format("dynamic friction is {:g}, which exceeds static "
                                          "friction, {:g}; swap `static` and `dynamic`",
                                          *sliding, *sticking)};
  }
  const bool are_equal = sliding && sticking && *sliding == *sticking;
  if (spec.dynamic && !are_equal && !spec.stribeck) {
    return Finding{"stribeck-velocity",
                   "the key \"stribeck-velocity\" is missing; where `static` and `dynamic` differ, "
                   "it sets the sliding speed over which one passes into the other"};
  }
  if (spec.stick == loads::FrictionStick::rigid && spec.slip) {
    return Finding{"slip",
                   "friction with `stick: rigid` does not slip before it slides; remove this key, "
                   "or write `stick: elastic`"};
  }
  const bool has_bristles = spec.stick == loads::FrictionStick::bristles;
  if (has_bristles && !spec.bristle_stiffness) {
    return Finding{"bristle-stiffness",
                   "the key \"bristle-stiffness\" is missing; `stick: bristles` needs it, for "
                   "example the largest friction over the displacement at which it breaks away"};
  }
  if (!has_bristles && (spec.bristle_stiffness || spec.bristle_damping)) {
    return Finding{spec.bristle_stiffness ? "bristle-stiffness" : "bristle-damping",
                   "this key belongs to `stick: bristles`; add that, or remove the key"};
  }
  if (has_bristles && spec.slip) {
    return Finding{"slip",
                   "bristles slip by their `bristle-stiffness`; remove this key, or write "
                   "`stick: elastic`"};
  }
  if (spec.coefficient.is_number(0.0) && spec.preload.is_number(0.0) &&
      spec.viscous.is_number(0.0)) {
    return Finding{"static",
                   "friction without `static`, `preload` or `viscous` has no effect; give "
                   "one of them"};
  }
  return std::nullopt;
}

Found friction_problem(const loads::HingeFrictionSpec& spec) {
  if (Found found = friction_problem(static_cast<const loads::JointFrictionBase&>(spec)))
    return found;
  if (spec.coefficient.is_number(0.0) || spec.radius > 0.0 || spec.axial_radius > 0.0) {
    return std::nullopt;
  }
  return Finding{
      "radius",
      fmt::format("forces on a pin of zero radius cause no friction torque, so `static{}` has no "
                  "effect; give the `radius` of the pin or the `axial-radius` of its collar, or {}",
                  shown(spec.coefficient),
                  !spec.preload.is_number(0.0) ? "leave out `static` and keep `preload` alone"
                                               : "a `preload` in place of `static`")};
}

/// A motor that has its speed or position exactly has limits, and no force beside them.
Found exact_motor_problem(const loads::MotorSpec& spec, bool turns) {
  const char* speed =
      spec.return_time ? (turns ? "angle" : "displacement") : (turns ? "speed" : "velocity");
  const char* limit = turns ? "torque-limit" : "force-limit";
  if (!spec.limit) {
    return Finding{
        speed, fmt::format("without `{}`, the gain on its error, the {} is held exactly, up "
                           "to a `{}`, which is missing; give one of them, or use `prescribed-{}`",
                           spec.return_time ? "stiffness" : "damping", speed, limit,
                           turns ? "rotation" : "translation")};
  }
  if (spec.force) {
    return Finding{turns ? "torque" : "force",
                   fmt::format("a motor that holds its {} exactly applies whatever force is "
                               "needed; remove this key, or give a `damping`",
                               speed)};
  }
  return std::nullopt;
}

/// A position is held exactly on the way back to it, or by gains.
Found return_problem(const loads::MotorSpec& spec, const char* position, const char* speed) {
  if (!spec.position) {
    return Finding{
        "return-time",
        fmt::format("there is no target `{0}` to return to; give a `{0}`, or remove this key",
                    position)};
  }
  if (!spec.stiffness.is_number(0.0) || !spec.damping.is_number(0.0)) {
    return Finding{"return-time",
                   "this key applies to a motor without gains; remove it, or remove `stiffness` "
                   "and `damping`"};
  }
  if (spec.speed && !spec.position->uses_signals()) {
    return Finding{speed, fmt::format("the rate of `{0}` follows from its law, and this key would "
                                      "contradict it; remove the key, or give `{0}` by signals",
                                      position)};
  }
  return std::nullopt;
}

/// The way back is left to the iteration of a step, which needs it to take some steps.
Found return_step_problem(const loads::MotorSpec& spec, const ModelDescription& model) {
  constexpr double kLeastSteps = 5;
  if (!spec.return_time || !model.simulation) return std::nullopt;
  const double step = model.simulation->step.value_or(0.0);
  if (*spec.return_time >= kLeastSteps * step * (1 - 1e-12)) return std::nullopt;
  return Finding{
      "return-time",
      fmt::format(
          "{:g} s is less than {:g} steps of {:g} s; give at least {:g} s, or a smaller `step`",
          *spec.return_time, kLeastSteps, step, kLeastSteps * step)};
}

/// A gain aims at something, and a motor does something.
Found motor_problem(const loads::MotorSpec& spec, bool turns) {
  const char* position = turns ? "angle" : "displacement";
  const char* speed = turns ? "speed" : "velocity";
  if (spec.return_time) {
    if (Found found = return_problem(spec, position, speed)) return found;
  } else if (spec.position && spec.stiffness.is_number(0.0)) {
    return Finding{
        position,
        fmt::format("a target `{0}` has no effect without `stiffness`, the gain on its error; give "
                    "this gain, or a `return-time` to follow it exactly within a `{1}`",
                    position, turns ? "torque-limit" : "force-limit")};
  }
  if (!spec.stiffness.is_number(0.0) && !spec.position) {
    return Finding{
        "stiffness",
        fmt::format("a gain on the {0} needs a target `{0}`, for example {0}: 0", position)};
  }
  if (spec.is_exact()) return exact_motor_problem(spec, turns);
  if (spec.power && !spec.limit) {
    return Finding{"power-limit",
                   fmt::format("a power does not limit the {} at rest, where none is delivered; "
                               "give the largest {} of the motor, too, as `{}`",
                               turns ? "torque" : "force", turns ? "torque" : "force",
                               turns ? "torque-limit" : "force-limit")};
  }
  if (spec.speed && spec.damping.is_number(0.0)) {
    return Finding{
        speed,
        fmt::format("a {0} has no effect without `damping`, the gain on its error; give this gain",
                    speed)};
  }
  if (!spec.damping.is_number(0.0) && !spec.position && !spec.speed) {
    return Finding{
        "damping",
        fmt::format("a gain on the {0} needs a target `{0}`, for example {0}: 0", speed)};
  }
  if (!spec.force && spec.stiffness.is_number(0.0) && spec.damping.is_number(0.0)) {
    const char* force = turns ? "torque" : "force";
    return Finding{force,
                   fmt::format("a motor without `{}`, `stiffness` or `damping` does nothing; "
                               "give one of them",
                               force)};
  }
  return std::nullopt;
}

}  // namespace

Found own_joint_problem(const loads::HingeSpringSpec& spec, const ModelDescription& model) {
  return law_problem(spec, model);
}

Found own_joint_problem(const loads::SlideSpringSpec& spec, const ModelDescription& model) {
  return law_problem(spec, model);
}

Found own_joint_problem(const loads::HingeStopSpec& spec, const ModelDescription& model) {
  if (Found found = law_problem(spec, model)) return found;
  return stop_problem(spec, "rad");
}

Found own_joint_problem(const loads::SlideStopSpec& spec, const ModelDescription& model) {
  if (Found found = law_problem(spec, model)) return found;
  return stop_problem(spec, "m");
}

Found own_joint_problem(const loads::RopeSpec& spec, const ModelDescription&) {
  return give_problem(spec);
}

Found own_joint_problem(const loads::HingeFrictionSpec& spec, const ModelDescription& model) {
  if (Found found = law_problem(spec, model)) return found;
  const joints::JointSpec& joint = *base::find_named(model.joints, spec.joint);
  if (!joint.has(base::CoordinateChoice::angle) || rolls(joint) ||
      joint.has(base::CoordinateChoice::second_angle)) {
    const bool is_cross = joint.has(base::CoordinateChoice::second_angle);
    const bool is_ball = std::holds_alternative<joints::SphericalSpec>(joint.kind);
    return Finding{
        "joint",
        fmt::format("joint \"{}\" is a {}, which rubs {}", spec.joint, joint.kind_name(),
                    is_cross  ? "on both of its arms; use `ball-friction`"
                    : is_ball ? "about all axes; use `ball-friction`"
                              : "in a different way; use the `damping` of a `hinge-spring`")};
  }
  return friction_problem(spec);
}

Found own_joint_problem(const loads::SlideFrictionSpec& spec, const ModelDescription& model) {
  if (Found found = law_problem(spec, model)) return found;
  const joints::JointSpec& joint = *base::find_named(model.joints, spec.joint);
  if (rolls(joint)) {
    return Finding{"joint", fmt::format("joint \"{}\" is a rolling, which does not slide; use the "
                                        "`damping` of a `slide-spring`, or a `slide-brake`",
                                        spec.joint)};
  }
  if (!joint.has(base::CoordinateChoice::displacement)) {
    return Finding{
        "joint",
        fmt::format(
            "joint \"{}\" is a {}, whose friction acts in the direction of sliding and not along "
            "each coordinate; use a `contact` with friction, or the `damping` of a `slide-spring`",
            spec.joint, joint.kind_name())};
  }
  return friction_problem(static_cast<const loads::JointFrictionBase&>(spec));
}

Found own_joint_problem(const loads::BallFrictionSpec& spec, const ModelDescription& model) {
  if (Found found = joint_problem(spec.joint, model)) return found;
  const joints::JointSpec& joint = *base::find_named(model.joints, spec.joint);
  const bool is_cross = std::holds_alternative<joints::UniversalSpec>(joint.kind);
  if (!is_cross && !std::holds_alternative<joints::SphericalSpec>(joint.kind)) {
    return Finding{"joint",
                   fmt::format("joint \"{}\" is a {}; name a spherical or universal one, or "
                               "use `hinge-friction` or `slide-friction`",
                               spec.joint, joint.kind_name())};
  }
  if (spec.length) {
    return Finding{"bearing-length", "balls and crosses carry no bending moments; remove this key"};
  }
  if (Found found = friction_problem(static_cast<const loads::JointFrictionBase&>(spec))) {
    return found;
  }
  if (spec.coefficient.is_number(0.0) || spec.radius > 0.0) return std::nullopt;
  return Finding{"radius", fmt::format("forces on a ball of zero radius cause no friction torque, "
                                       "so `static{}` has no effect; give the `radius`",
                                       shown(spec.coefficient))};
}

Found own_joint_problem(const loads::HingeMotorSpec& spec, const ModelDescription& model) {
  if (Found found = law_problem(spec, model)) return found;
  if (Found found = motor_problem(spec, true)) return found;
  return return_step_problem(spec, model);
}

Found own_joint_problem(const loads::SlideMotorSpec& spec, const ModelDescription& model) {
  if (Found found = law_problem(spec, model)) return found;
  if (Found found = motor_problem(spec, false)) return found;
  return return_step_problem(spec, model);
}

Found own_joint_problem(const loads::HingeBrakeSpec& spec, const ModelDescription& model) {
  return law_problem(spec, model);
}

Found own_joint_problem(const loads::SlideBrakeSpec& spec, const ModelDescription& model) {
  return law_problem(spec, model);
}

Found own_joint_problem(const loads::ElasticBeltSpec& spec, const ModelDescription&) {
  if (spec.coefficient && *spec.coefficient > 0.0 && spec.pretension == 0.0) {
    return Finding{"pretension",
                   "a belt with `friction` transmits no force without pretension; give it a "
                   "pretension, or remove `friction` for a toothed belt"};
  }
  return std::nullopt;
}

Found own_joint_problem(const BeltSensor& spec, const ModelDescription& model) {
  std::vector<std::string> known;
  for (const loads::LoadSpec& load : model.loads) {
    if (std::holds_alternative<loads::ElasticBeltSpec>(load.kind)) known.push_back(load.name);
  }
  if (std::find(known.begin(), known.end(), spec.belt) != known.end()) return std::nullopt;
  return Finding{"belt", fmt::format("there is no elastic-belt \"{}\".{}", spec.belt,
                                     known.empty() ? " The model has none."
                                                   : base::suggestion(spec.belt, known))};
}

Found own_joint_problem(const JointCoordinateSensor& spec, const ModelDescription& model) {
  return coordinate_problem({spec.joint, spec.which, base::CoordinateSort::any}, model);
}

Found own_joint_problem(const joints::ScrewSpec& spec, const ModelDescription&) {
  if (spec.pitch == 0.0) {
    return Finding{"pitch",
                   "a screw with zero pitch does not move along its axis; give a pitch, or use a "
                   "`revolute` joint"};
  }
  return axis_problem(spec.axis);
}

}  // namespace buckens::model
