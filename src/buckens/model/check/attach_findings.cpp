// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

/// What to do instead where a joint cannot be attached, empty where it can: gears, racks, belts,
/// screws, points on curves, sliders and wheels look anew.
std::string instead_of_attaching(const std::string& kind) {
  if (kind == "prescribed-rotation") {
    return "let the event switch on a `hinge-motor` with `angle` and `stiffness`";
  }
  if (kind == "prescribed-translation") {
    return "let the event switch on a `slide-motor` with `displacement` and `stiffness`";
  }
  if (kind == "prescribed-coordinate") {
    return "let the event switch on a `hinge-motor` or `slide-motor` with `stiffness`";
  }
  if (kind == "coupler") {
    return "use a `gear`, `rack`, `belt` or `screw`, which engage in their position at that time";
  }
  return {};
}

}  // namespace

Finding released_play_problem(const joints::JointSpec& joint, const char* key) {
  return Finding{
      key, fmt::format(
               "joint \"{}\" has `backlash`, and events cannot release or attach such teeth; use "
               "an `elastic-gear` load, which events can switch on and off, or remove the backlash",
               joint.name)};
}

Found attached_problem(const std::vector<std::string>& joints, const char* key,
                       const ModelDescription& model) {
  for (const std::string& name : joints) {
    const auto* joint = base::find_named(model.joints, name);
    if (joint == nullptr) {
      return Finding{key, fmt::format("unknown joint \"{}\".{}", name,
                                      base::suggestion(name, names_of(model.joints)))};
    }
    if (std::holds_alternative<joints::BushingSpec>(joint->kind)) {
      return Finding{key,
                     fmt::format("joint \"{}\" is a bushing; loads and bushings are switched on "
                                 "and off",
                                 name)};
    }
    if (has_play(*joint)) return released_play_problem(*joint, key);
    if (const std::string instead = instead_of_attaching(joint->kind_name()); !instead.empty()) {
      return Finding{key, fmt::format("joint \"{}\" is a {}, which measures from its position as "
                                      "placed and cannot be attached during a run; {}",
                                      name, joint->kind_name(), instead)};
    }
  }
  return std::nullopt;
}

}  // namespace buckens::model
