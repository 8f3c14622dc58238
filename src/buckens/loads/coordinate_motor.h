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
  // Below zero, these count as zero.
  base::SignalLaw stiffness;         ///< [N m/rad] or [N/m]
  base::SignalLaw damping;           ///< [N m s/rad] or [N s/m]
  base::SignalLaw limit = HUGE_VAL;  ///< [N m] or [N]
  base::SignalLaw power = HUGE_VAL;  ///< [W], while it drives
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

  /// The most that it delivers [W], HUGE_VAL without a limit; below zero counts as zero.
  const base::SignalLaw& power() const { return data_.power; }

  bool uses_signals() const override;
  bool is_constant() const override;

 private:
  ProjectedForce force(const Sight& sight) const override;

  MotorData data_;
};

/// Holds the rate of a joint coordinate as far as its force reaches: a rigid row with a bounded
/// multiplier, which stalls exactly. Regimes: 1 holds; 2 and 3 slip forwards and backwards against
/// the rate that it aims at; 4 is open, its bound zero.
class RateHold : public RigidLaw {
 public:
  /// Holds where it has its rate, slips elsewhere.
  void start_states(const Sight& sight, double* states) const final;
  int struck_regime(const Sight& sight, double rounding) const final;

 protected:
  /// Most that it resists with in the direction of a force [N m] or [N]; below zero counts as zero.
  virtual double most(const Sight& sight, double force) const = 0;
  /// Rate that it holds [rad/s] or [m/s].
  virtual double aimed(const Sight& /*sight*/) const { return 0.0; }

 private:
  RigidRow row(const Sight& sight) const final;
};

/// Brake on a joint coordinate, its bound a law of time and signals.
class CoordinateBrake final : public RateHold {
 public:
  explicit CoordinateBrake(base::SignalLaw bound) : bound_(std::move(bound)) {}

  /// The most that it holds [N m] or [N].
  double bound(const Sight& sight) const { return bound_.value(sight.t, sight.signals); }

  bool uses_signals() const override { return bound_.uses_signals(); }

 private:
  double most(const Sight& sight, double /*force*/) const override { return bound(sight); }

  base::SignalLaw bound_;
};

/// What an exact motor is told, and how much it can; quantities along its coordinate.
struct ServoData {
  std::optional<base::SignalLaw> position;  ///< [rad] or [m]
  std::optional<base::SignalLaw> speed;  ///< [rad/s] or [m/s]; none: rate of the position, if known
  double return_time = 0;                ///< [s] > 0 with a position
  // Below zero, these count as zero.
  base::SignalLaw limit = HUGE_VAL;  ///< [N m] or [N]
  base::SignalLaw power = HUGE_VAL;  ///< [W], while it drives
};

/// Motor that has its speed exactly, whatever force that takes, up to its limits:
///
///     ξ̇ = ξ̇₀ + (ξ₀ − ξ)/T,   |f| ≤ b,   f ξ̇ ≤ P                                       (S5)
class CoordinateServo final : public RateHold {
 public:
  explicit CoordinateServo(ServoData data) : data_(std::move(data)) {}

  /// The most that it delivers [W], HUGE_VAL without a limit; below zero counts as zero.
  const base::SignalLaw& power() const { return data_.power; }

  bool uses_signals() const override;
  bool is_source() const override { return true; }
  double aimed_acceleration(const Sight& sight) const override;

 private:
  double most(const Sight& sight, double force) const override;
  double aimed(const Sight& sight) const override;
  /// Of its law, without what leads back to the position.
  double law_rate(const Sight& sight) const;

  ServoData data_;
};

}  // namespace buckens::loads
