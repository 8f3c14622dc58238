// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/coordinate_look.h"

namespace buckens::joints {

/// Measurement of a joint coordinate that an axis does not define: distance along a curve
/// (PathCoordinate), angles of a ball joint (Swing, Twist), distance rolled by a wheel
/// (RolledWay).
class CoordinateMeasure {
 public:
  virtual ~CoordinateMeasure() = default;
  /// Whether it is an angle [rad] rather than a length [m].
  virtual bool is_angle() const = 0;
  /// After what it repeats, so that turns must be counted [rad] or [m]; 0: it does not.
  virtual double turn() const { return is_angle() ? kTurn : 0.0; }
  /// @param before value at the previous step, or where it is to be expected, needed where turns
  ///        are counted or a curve crosses itself; null: the point nearest of all
  virtual CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                              const CountedValue* before) const = 0;
  /// Part of its acceleration that is independent of the accelerations of the bodies' coordinates.
  virtual double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
                      const CountedValue* before) const = 0;
};

}  // namespace buckens::joints
