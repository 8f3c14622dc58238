// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/coordinate_measure.h"

namespace buckens::joints {

/// How fast M turns relative to F about an axis a that is fixed in F: a·(ω_M − ω_F). In space this
/// is the rate of no angle (nonholonomic), and the value of the coordinate is zero.
class TurningRate final : public CoordinateMeasure {
 public:
  /// @param axis_F a, unit vector in F
  explicit TurningRate(const Eigen::Vector3d& axis_F) : axis_F_(axis_F) {}

  bool is_angle() const override { return true; }
  double turn() const override { return 0.0; }
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before) const override;

 private:
  Eigen::Vector3d axis_F_;
};

}  // namespace buckens::joints
