// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/coordinate_measure.h"

namespace buckens::joints {

/// Angle between an axis a that F holds and an axis b that M holds, 0 … π:
///
///     cos φ = a·b,   φ̇ = u·(ω_M − ω_F),   u = a × b / sin φ                                 (R38)
///
/// Where they are parallel (φ = 0, or π) u is the direction about which they are just parting
/// (closing), or any if they do not move: a force along φ that vanishes there is well defined, and
/// no other.
class Swing final : public CoordinateMeasure {
 public:
  /// @param axis_F,axis_M a in F and b in M, unit vectors
  Swing(const Eigen::Vector3d& axis_F, const Eigen::Vector3d& axis_M)
      : axis_F_(axis_F), axis_M_(axis_M) {}

  bool is_angle() const override { return true; }
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before) const override;

 private:
  Eigen::Vector3d axis_F_, axis_M_;
};

/// How far M has turned about its axis b beside the shortest turn that swings a to b:
///
///     R_FM = exp(φ u) exp(τ a) R_FM⁰,   τ̇ = (a + b)·(ω_M − ω_F) / (1 + cos φ)               (R39)
///
/// with R_FM⁰ that of τ = φ = 0. Joints of constant velocity keep it at zero. It is singular where
/// the axes are opposite, φ = π.
class Twist final : public CoordinateMeasure {
 public:
  /// @param axis_F a, unit vector in F, @param other_F b as placed, unit vector in F
  /// @param R_FM_placed orientation of M in F as placed, where the twist is zero
  Twist(const Eigen::Vector3d& axis_F, const Eigen::Vector3d& other_F,
        const Eigen::Matrix3d& R_FM_placed);

  bool is_angle() const override { return true; }
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before) const override;

 private:
  Eigen::Vector3d axis_F_, x_F_, y_F_;  // right-handed, in F
  Eigen::Vector3d axis_M_, x_M_, y_M_;  // what they are at τ = φ = 0, in M
};

}  // namespace buckens::joints
