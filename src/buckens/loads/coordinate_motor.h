// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/base/signal_law.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::loads {

/// What a motor is told, and how much it can; quantities along its coordinate.
struct MotorData {
  std::optional<base::SignalLaw> force;     ///< [N m] or [N]
  std::optional<base::SignalLaw> position;  ///< [rad] or [m]
  std::optional<base::SignalLaw> speed;     ///< [rad/s] or [m/s]; none: rate of the position
  double stiffness = 0;                     ///< [N m/rad] or [N/m]
  double damping = 0;                       ///< [N m s/rad] or [N s/m]
  double limit = HUGE_VAL;                  ///< [N m] or [N]
  double power = HUGE_VAL;                  ///< [W], while it drives
};

/// Motor on a joint coordinate ξ: a bounded row that stalls exactly at its limit,
///
///     f = proj_[−b, b](f₀ + k (ξ₀ − ξ) + c (ξ̇₀ − ξ̇)),   f ξ̇ ≤ P
///
/// Gains are part of the iteration of a step, so stiff ones are stable. Theory:
/// docs/theory/24-control.md §1.
class CoordinateMotor final : public CoordinateLaw {
 public:
  explicit CoordinateMotor(MotorData data) : data_(std::move(data)) {}

  bool uses_signals() const override;
  bool is_constant() const override;

 private:
  ProjectedForce force(const Sight& sight) const override;

  MotorData data_;
};

/// Brake on a joint coordinate: a rigid row whose force is bounded by a law of time and signals.
/// Regimes: 1 holds; 2 and 3 slip forwards and backwards; 4 is open, its bound zero.
class CoordinateBrake final : public RigidLaw {
 public:
  /// @param bound [N m] or [N]; below zero counts as zero
  explicit CoordinateBrake(base::SignalLaw bound) : bound_(std::move(bound)) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  /// Holds at rest, slips where it moves.
  void start_states(const Sight& sight, double* states) const override;

 private:
  RigidRow row(const Sight& sight) const override;

  base::SignalLaw bound_;
};

}  // namespace buckens::loads
