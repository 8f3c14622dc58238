// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/cross_shafts.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/shaft_pairs.h"

namespace buckens::model {

namespace {

// Cosine of the largest angle between shafts: of 85 degrees.
constexpr double kLargestBend = 0.08715574274765817;

}  // namespace

void require_bent_shafts(MarkerFinder& find) {
  const auto axis = [&find](const Bearing& bearing) -> Eigen::Vector3d {
    return find.placed(bearing.joint->first).R() * bearing.joint->axis_F;
  };
  for (const ShaftPair& pair : shaft_pairs(find.model())) {
    const double cosine = std::abs(axis(pair.first).dot(axis(pair.second)));
    if (!pair.has_common_carrier || cosine >= kLargestBend) continue;
    throw ModelError(
        pair.cross->where,
        fmt::format(
            "joint \"{}\": the shafts that it connects, in joints \"{}\" and \"{}\", meet at "
            "{:.4g} degrees; a universal joint is singular at 90 degrees and transmits no rotation "
            "there; keep the angle below 85 degrees, or use a `gear` or a `coupler`",
            pair.cross->name, pair.first.joint->name, pair.second.joint->name,
            std::acos(cosine) * 180.0 / std::numbers::pi));
  }
}

}  // namespace buckens::model
