// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

/// With which value the coordinate on which a stop acts starts, if that is given; else as placed.
struct StopStart {
  double value = 0;
  bool is_given = false;
};

/// @return none for what is not zero as placed, and for what a joint does not have
std::optional<StopStart> start_of(const loads::JointStop& stop, bool turns,
                                  const ModelDescription& model) {
  const auto* joint = base::find_named(model.joints, stop.joint);
  if (joint == nullptr) return std::nullopt;
  const auto which =
      base::meant(joint->coordinates(), stop.which,
                  turns ? base::CoordinateSort::angles : base::CoordinateSort::displacements);
  if (!which) return std::nullopt;
  const auto* given = base::find_named(model.initial.joints, stop.joint);
  if (given != nullptr && given->value(*which)) return StopStart{*given->value(*which), true};
  // A swing is what the axes are, which is known when the bodies are placed.
  if (*which == base::CoordinateChoice::swing) return std::nullopt;
  return StopStart{0.0, given != nullptr};
}

Found start_problem(const loads::JointStop& stop, bool turns, const ModelDescription& model) {
  const std::optional<StopStart> found = start_of(stop, turns, model);
  if (!found) return std::nullopt;
  const double start = found->value;
  const bool is_before = stop.from && start < *stop.from;
  if (!is_before && !(stop.to && start > *stop.to)) return std::nullopt;
  const bool is_given = found->is_given;
  return Finding{
      is_before ? "from" : "to",
      fmt::format(
          "the joint starts at {:g} {}{}, outside its stops from {} to {} {}; {}", start,
          turns ? "rad" : "m", is_given ? "" : ", as placed",
          stop.from ? fmt::format("{:g}", *stop.from) : "-infinity",
          stop.to ? fmt::format("{:g}", *stop.to) : "infinity", turns ? "rad" : "m",
          is_given ? "start it within them"
                   : "place the bodies within the stops, or set a start within them by `initial`")};
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
  std::vector<std::string> keys;
  bool is_empty = true;
  for (const base::CoordinateName& name : base::kCoordinateNames) {
    keys.insert(keys.end(), {name.key, name.rate_key});
    is_empty = is_empty && spec.key_of(name) == nullptr;
  }
  if (is_empty) {
    return Finding{"", fmt::format("at least one of the keys {} is needed", fmt::join(keys, ", "))};
  }
  const auto* joint = base::find_named(model.joints, spec.name);
  if (joint != nullptr && joint->laws().num_given() > 0) {
    return Finding{
        "", fmt::format(
                "joint \"{}\" is a drive, whose law determines where it starts; change that law",
                spec.name)};
  }
  for (const base::CoordinateName& name : base::kCoordinateNames) {
    const char* key = spec.key_of(name);
    if (key == nullptr) continue;
    if (Found found = coordinate_problem(
            {spec.name, name.which, base::CoordinateSort::any, key, key}, model)) {
      return found;
    }
  }
  return std::nullopt;
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
                   fmt::format("the equilibrium is computed with all joints, including \"{}\"; "
                               "remove `start: static`, or let an event release the joint",
                               spec.released.front())};
  }
  if (!spec.off.empty() && spec.start == StartKind::static_equilibrium) {
    return Finding{"off",
                   fmt::format("the equilibrium is computed with all loads, including \"{}\"; "
                               "remove `start: static`, or let an event switch the load off",
                               spec.off.front())};
  }
  if (spec.start != StartKind::static_equilibrium) return std::nullopt;
  for (const InitialJointSpec& joint : spec.joints) {
    for (const base::CoordinateName& name : base::kCoordinateNames) {
      if (!joint.value(name.which)) continue;
      return Finding{"start", fmt::format("the equilibrium determines where joint \"{}\" starts; "
                                          "remove its {} under `joints`, or `start: static`",
                                          joint.name, name.key)};
    }
  }
  return std::nullopt;
}

}  // namespace buckens::model
