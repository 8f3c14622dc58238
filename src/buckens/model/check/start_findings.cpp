// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

/// With which value the coordinate of a joint starts: zero as placed.
double start_of(const loads::JointStop& stop, bool turns, const ModelDescription& model) {
  const auto* given = base::find_named(model.initial.joints, stop.joint);
  if (given == nullptr) return 0.0;
  if (stop.which == loads::AngleChoice::second_angle) return given->second_angle.value_or(0.0);
  return (turns ? given->angle : given->displacement).value_or(0.0);
}

Found start_problem(const loads::JointStop& stop, bool turns, const ModelDescription& model) {
  const double start = start_of(stop, turns, model);
  const bool is_before = stop.from && start < *stop.from;
  if (!is_before && !(stop.to && start > *stop.to)) return std::nullopt;
  const bool is_given = base::find_named(model.initial.joints, stop.joint) != nullptr;
  return Finding{
      is_before ? "from" : "to",
      fmt::format("the joint starts at {:g} {}{}, outside of its stops from {} to {} {}; {}", start,
                  turns ? "rad" : "m", is_given ? "" : ", as placed",
                  stop.from ? fmt::format("{:g}", *stop.from) : "-infinity",
                  stop.to ? fmt::format("{:g}", *stop.to) : "infinity", turns ? "rad" : "m",
                  is_given ? "start it within them"
                           : "place the bodies within them, or start "
                             "there by `initial`")};
}

}  // namespace

Found stops_problem(const ModelDescription& model) {
  for (const loads::LoadSpec& load : model.loads) {
    const Found found = std::visit(
        [&]<class T>(const T& kind) -> Found {
          if constexpr (std::is_base_of_v<loads::JointStop, T>) {
            return under(T::kKey, start_problem(kind, T::kTurns, model));
          }
          return std::nullopt;
        },
        load.kind);
    if (found) return under("loads", under(load.name, found));
  }
  return std::nullopt;
}

Found problem(const InitialJointSpec& spec, const ModelDescription& model) {
  const bool turns = spec.angle || spec.speed;
  const bool slides = spec.displacement || spec.velocity;
  const bool turns_twice = spec.second_angle || spec.second_speed;
  if (!turns && !slides && !turns_twice) {
    return Finding{
        "",
        "at least one of the keys angle, speed, second-angle, second-speed, displacement "
        "and velocity is needed"};
  }
  const auto* joint = base::find_named(model.joints, spec.name);
  if (joint != nullptr &&
      (std::holds_alternative<joints::PrescribedRotationSpec>(joint->kind) ||
       std::holds_alternative<joints::PrescribedTranslationSpec>(joint->kind))) {
    return Finding{"",
                   fmt::format("joint \"{}\" is a drive, whose law says where it starts; change "
                               "that law",
                               spec.name)};
  }
  if (spec.angle || spec.speed) {
    if (Found found = coordinate_problem(spec.name, true, model, spec.angle ? "angle" : "speed")) {
      return found;
    }
  }
  if (turns_twice) {
    const char* key = spec.second_angle ? "second-angle" : "second-speed";
    if (Found found = second_angle_problem(spec.name, model, key)) return found;
  }
  if (!spec.displacement && !spec.velocity) return std::nullopt;
  return coordinate_problem(spec.name, false, model,
                            spec.displacement ? "displacement" : "velocity");
}

Found problem(const InitialSpec& spec, const ModelDescription& model) {
  for (const std::string& name : spec.off) {
    if (base::find_named(model.loads, name) != nullptr) continue;
    return Finding{"off", fmt::format("unknown load \"{}\".{}", name,
                                      base::suggestion(name, names_of(model.loads)))};
  }
  if (Found found = attached_problem(spec.released, "released", model)) return found;
  if (!spec.released.empty() && spec.start == StartKind::static_equilibrium) {
    return Finding{"released",
                   fmt::format("the equilibrium counts all joints, \"{}\" among them; remove "
                               "`start: static`, or let an event release the joint",
                               spec.released.front())};
  }
  if (!spec.off.empty() && spec.start == StartKind::static_equilibrium) {
    return Finding{"off", fmt::format("the equilibrium counts all loads, \"{}\" among them; remove "
                                      "`start: static`, or let an event switch the load off",
                                      spec.off.front())};
  }
  if (spec.start != StartKind::static_equilibrium) return std::nullopt;
  for (const InitialJointSpec& joint : spec.joints) {
    if (!joint.angle && !joint.second_angle && !joint.displacement) continue;
    return Finding{"start", fmt::format("the equilibrium decides where joint \"{}\" starts; remove "
                                        "its {} under `joints`, or `start: static`",
                                        joint.name, joint.displacement ? "displacement" : "angle")};
  }
  return std::nullopt;
}

}  // namespace buckens::model
