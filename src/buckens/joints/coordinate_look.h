// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/counted_value.h"
#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

using spatial::CountedValue;
using spatial::kTurn;

/// A coordinate at one instant.
struct CoordinateLook {
  double fraction = 0;  ///< as JointCoordinate::fraction()
  double rate = 0;      ///< J V
  spatial::PairRow J = spatial::PairRow::Zero();

  /// Computes the rate from J.
  void take_rate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) {
    rate = J.segment<3>(0).dot(F.w) + J.segment<3>(3).dot(F.v) + J.segment<3>(6).dot(M.w) +
           J.segment<3>(9).dot(M.v);
  }
};

}  // namespace buckens::joints
