// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/base/signal_law.h"
#include "buckens/loads/coordinate_law.h"

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

}  // namespace buckens::loads
