// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/base/path_spec.h"
#include "buckens/joints/space_curve.h"

namespace buckens::model {

/// The lines and arcs of a path; none where it is a spline.
std::vector<joints::CurveStep> curve_steps(const base::PathSpec& spec);

/// @throws ModelError if they make no smooth curve
std::shared_ptr<const joints::SpaceCurve> curve_of_path(const base::PathSpec& spec);

}  // namespace buckens::model
