// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/coordinate_measure.h"
#include "buckens/joints/rolling_row.h"

namespace buckens::joints {

/// How far a wheel has turned about its axle, relative to the direction in which it rolls, from
/// where it was placed:
///
///     φ̇ = (a − (a·n)/|n − a (a·n)| e)·(ω_M − ω_F)                                        (R40)
///
/// with the notation of RollingRow. It is the angle of a mark on the wheel from the direction ahead
/// in the wheel's plane, so that it depends on no way; a wheel that turns about its point of
/// contact, or leans, has not rolled. Multiplied by the radius it is the way along the trace on the
/// plane, of wheels that stand upright or have a sharp edge.
class RolledWay final : public CoordinateMeasure {
 public:
  /// @param R_FM_placed orientation of M in F as placed
  /// @param is_angle the angle, counted over turns; else the way, radius times the angle
  RolledWay(const RollingRow::Data& data, const Eigen::Matrix3d& R_FM_placed, bool is_angle);

  double turn() const override { return scale_ * kTurn; }
  bool is_angle() const override { return is_angle_; }
  /// @throws NumericalError if the wheel lies flat
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before) const override;

 private:
  RollingRow::Data data_;
  bool is_angle_;
  double scale_;            // 1 or R
  Eigen::Vector3d mark_M_;  // on the wheel, ahead as placed
};

}  // namespace buckens::joints
