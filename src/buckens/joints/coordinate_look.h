// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// A coordinate with whole turns stored separately, so that many turns do not cost digits.
struct CountedValue {
  int turns = 0;        ///< of an angle; 0 of a displacement
  double fraction = 0;  ///< angle within the turn, −π … π [rad], or displacement [m]

  /// The whole angle [rad] or displacement [m].
  double value() const;
};

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
