// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// The angle by which a direction x of marker M has turned about an axis a of marker F: that of its
/// projection across a. Where axes tilt, as on bent shafts, rates are still exactly those of the
/// angle:
///
///     θ̇ = m·(ω_M − ω_F),   m = (a − q x)/(1 − q²),   q = a·x                              (R7)
///
/// World components; nothing is remembered, so θ is an angle within the turn.
class RelativeTurn {
 public:
  /// @param axis,x unit vectors a and x
  RelativeTurn(const Eigen::Vector3d& axis, const Eigen::Vector3d& x)
      : a_(axis), x_(x), q_(axis.dot(x)), across_(1.0 - q_ * q_) {}

  Eigen::Vector3d derivative() const { return (a_ - q_ * x_) / across_; }

  /// Part of θ̈ without accelerations of coordinates.
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M) const {
    const Eigen::Vector3d w = M.w - F.w;
    const Eigen::Vector3d w_dot = bias_M.alpha - bias_F.alpha - F.w.cross(M.w);  // seen from F
    const double q_dot = a_.dot(w.cross(x_));
    const double rate = derivative().dot(w);
    return derivative().dot(w_dot) + (2.0 * q_ * rate - x_.dot(w)) * q_dot / across_;
  }

 private:
  Eigen::Vector3d a_, x_;
  double q_, across_;
};

/// Second derivative of M's place as seen from F, without accelerations of coordinates. World
/// components.
inline Eigen::Vector3d relative_bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                                     const spatial::MarkerBias& bias_F,
                                     const spatial::MarkerBias& bias_M) {
  const Eigen::Vector3d r = M.p - F.p;
  const Eigen::Vector3d rate = M.v - F.v - F.w.cross(r);
  return bias_M.a - bias_F.a - bias_F.alpha.cross(r) - 2.0 * F.w.cross(rate) -
         F.w.cross(F.w.cross(r));
}

}  // namespace buckens::joints
