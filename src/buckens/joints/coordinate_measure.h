// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/coordinate_look.h"

namespace buckens::joints {

/// How a joint coordinate is measured where that takes more than an axis: the way along a curve
/// (PathCoordinate), the angles of a ball joint (Swing, Twist), how far a wheel has rolled
/// (RolledWay).
class CoordinateMeasure {
 public:
  virtual ~CoordinateMeasure() = default;
  /// Whether it is an angle [rad], and no length [m].
  virtual bool is_angle() const = 0;
  /// @param before where it was a step before: curves that cross themselves have several places
  ///        nearby; null: the nearest of all
  virtual CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                              const CountedValue* before) const = 0;
  /// Part of its acceleration without accelerations of the bodies' coordinates.
  virtual double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
                      const CountedValue* before) const = 0;
};

}  // namespace buckens::joints
