// SPDX-License-Identifier: Apache-2.0
// What is wrong with cross joints.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

/// Both arms of a cross are given in the same axes.
Found arms_problem(const joints::UniversalSpec& spec) {
  const double size = spec.axis.norm() * spec.second_axis.norm();
  if (size == 0.0) {
    return Finding{"second-axis", "an axis cannot be [0, 0, 0]; give its direction"};
  }
  const double cosine = spec.axis.dot(spec.second_axis) / size;
  if (std::abs(cosine) <= 1e-4) return std::nullopt;
  return Finding{"second-axis",
                 fmt::format("the arms of a universal joint must be perpendicular, but these meet "
                             "at {:.4g} degrees; rotate one of them",
                             std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi)};
}

}  // namespace

Found own_joint_problem(const joints::UniversalSpec& spec, const ModelDescription&) {
  if (Found found = axis_problem(spec.axis)) return found;
  return arms_problem(spec);
}

}  // namespace buckens::model
