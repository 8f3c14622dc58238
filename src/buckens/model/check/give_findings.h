// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include "buckens/model/check/finding.h"

namespace buckens::model {

/// Whether a stop, rope or cam is asked to be elastic and rigid at once.
template <class Spec>
Found give_problem(const Spec& spec) {
  if (spec.stiffness && (spec.restitution || spec.threshold)) {
    return Finding{spec.restitution ? "restitution" : "threshold",
                   "this key belongs to rigid stops, ropes and cams; leave out `stiffness` to make "
                   "it rigid, or remove this key"};
  }
  if (!spec.stiffness && spec.damping > 0.0) {
    return Finding{"damping",
                   "without `stiffness` it is rigid and has no damping; give a `stiffness` as "
                   "well, or `restitution` instead"};
  }
  if (spec.restitution.value_or(0.0) > 1.0) {
    return Finding{
        "restitution",
        fmt::format("expected 0 to 1, found {:g}: a rebound cannot be faster than the approach",
                    *spec.restitution)};
  }
  return std::nullopt;
}

}  // namespace buckens::model
