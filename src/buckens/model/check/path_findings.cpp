// SPDX-License-Identifier: Apache-2.0
// What is wrong with the curves of slots and cams.
#include <fmt/format.h>

#include "buckens/model/check/give_findings.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

Found path_problem(const base::PathSpec& spec) {
  if (spec.path.empty() == spec.segments.empty()) {
    return Finding{"",
                   "exactly one of the keys path and segments is needed: points of a smooth curve, "
                   "or lines and arcs"};
  }
  if (spec.start && spec.segments.empty()) {
    return Finding{"start", "it belongs to `segments`; a `path` starts at its first point"};
  }
  return std::nullopt;
}

Found normal_problem(const std::optional<Eigen::Vector3d>& normal) {
  if (!normal || normal->norm() > 0.0) return std::nullopt;
  return Finding{"normal", "[0, 0, 0] is not a direction; give for example [0, 0, 1]"};
}

}  // namespace

Found problem(const base::PathSegmentSpec& spec, const ModelDescription& /*model*/) {
  if (spec.line.has_value() == spec.arc.has_value()) {
    return Finding{"",
                   "exactly one of the keys line and arc is needed, for example "
                   "line: [80 mm, 0, 0]"};
  }
  if (spec.line && (spec.through || spec.centre)) {
    return Finding{spec.through ? "through" : "centre",
                   "it belongs to an `arc`; remove it, or write `arc` in place of `line`"};
  }
  if (spec.through && spec.centre) {
    return Finding{"centre", "`through` already determines the arc; remove one of them"};
  }
  return std::nullopt;
}

Found own_joint_problem(const joints::SlotSpec& spec, const ModelDescription& /*model*/) {
  if (Found found = path_problem(spec)) return found;
  return normal_problem(spec.normal);
}

Found own_joint_problem(const loads::CamSpec& spec, const ModelDescription& model) {
  if (Found found = path_problem(spec)) return found;
  if (!spec.normal && !model.planar) {
    return Finding{"",
                   "the key \"normal\" is missing; a model in space needs the normal of the plane "
                   "of the curve, for example normal: [0, 0, 1]"};
  }
  if (Found found = normal_problem(spec.normal)) return found;
  return give_problem(spec);
}

}  // namespace buckens::model
