// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/reduction_conflict.h"

namespace buckens::body {

namespace {

std::optional<ReductionConflict> choice_conflict(const ReductionSpec& spec) {
  const int bases =
      (spec.free_free ? 1 : 0) + (spec.craig_bampton ? 1 : 0) + (spec.is_automatic() ? 1 : 0);
  if (bases > 1) {
    return ReductionConflict{"reduction",
                             "a body has one basis: give one of auto, free-free and craig-bampton"};
  }
  if (bases == 0 && !spec.file.empty()) {
    return ReductionConflict{"reduction.file",
                             "there is no basis to keep in it; add free-free or craig-bampton"};
  }
  if (spec.craig_bampton &&
      spec.craig_bampton->modes.has_value() == spec.craig_bampton->cutoff.has_value()) {
    return ReductionConflict{"reduction.craig-bampton",
                             "exactly one of the keys modes and cutoff is needed"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<ReductionConflict> reduction_conflict(const BodySpec& spec) {
  const bool is_reduced = !spec.reduction.is_none();
  const bool is_quasi_static = spec.flexibility == Flexibility::quasi_static;
  if (auto found = choice_conflict(spec.reduction)) return found;
  if (!is_reduced && !is_quasi_static) return std::nullopt;
  const char* key = is_reduced ? "reduction" : "flexibility";
  if (spec.is_rigid()) {
    return ReductionConflict{key, "a rigid body does not deform; remove the key"};
  }
  if (!spec.frames.is_one()) {
    return ReductionConflict{key,
                             "a reduced or quasi-static body has one frame; remove `frames`, or "
                             "keep the full mesh, whose parts are small"};
  }
  if (spec.geometric_stiffness) {
    return ReductionConflict{"geometric-stiffness",
                             "it acts on the full mesh only; remove it, or keep the full mesh"};
  }
  if (is_quasi_static && (spec.reduction.craig_bampton || spec.reduction.is_automatic())) {
    return ReductionConflict{"reduction",
                             "a quasi-static body has the deformations by static loads anyhow; "
                             "only `free-free` adds to them"};
  }
  return std::nullopt;
}

}  // namespace buckens::body
