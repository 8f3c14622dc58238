// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

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
    // Gears, racks, belts and couplers count from where they were placed; so do drives. Slots and
    // wheels look anew.
    const std::string kind = joint->kind_name();
    const bool is_plain = kind == "revolute" || kind == "spherical" || kind == "prismatic" ||
                          kind == "fixed" || kind == "cylindrical" || kind == "planar" ||
                          kind == "universal" || kind == "constant-velocity" ||
                          kind == "point-on-line" || kind == "point-in-plane" ||
                          kind == "parallel" || kind == "orientation" || kind == "distance" ||
                          kind == "slot" || kind == "rolling";
    if (is_plain) continue;
    return Finding{key, fmt::format("joint \"{}\" is a {}, which remembers how it was placed and "
                                    "cannot be attached during a run; use a revolute, spherical, "
                                    "prismatic, fixed or similar joint",
                                    name, kind)};
  }
  return std::nullopt;
}

}  // namespace buckens::model
