// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// A length between two bodies with a law of its own: a roller above a curve (CurveGap), surfaces
/// that touch (ContactWay).
class GapLaw {
 public:
  virtual ~GapLaw() = default;
  virtual double gap(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const = 0;
  /// J: its rate is J V.
  virtual spatial::PairRow derivatives(const spatial::MarkerMotion& F,
                                       const spatial::MarkerMotion& M) const = 0;
  /// Part of its acceleration without accelerations of the bodies' coordinates.
  virtual double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const spatial::MarkerBias& bias_F,
                      const spatial::MarkerBias& bias_M) const = 0;
};

}  // namespace buckens::joints
