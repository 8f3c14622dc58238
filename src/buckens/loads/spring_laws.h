// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include "buckens/base/signal_law.h"

namespace buckens::loads {

/// What a spring and damper is at one instant.
struct SpringNumbers {
  double stiffness = 0;  ///< k [N/m] or [N m/rad]
  double damping = 0;    ///< c [N s/m] or [N m s/rad]
  double free = 0;       ///< where the spring is free of force [m] or [rad]
};

/// The parameters of a spring and damper: numbers, laws of time or formulas of signals. Stiffness
/// and damping below zero count as zero.
///
/// The energy of a spring is that with its parameters of the instant; what it gains as these change
/// is work from outside, see analysis::ParameterWork.
class SpringLaws {
 public:
  SpringLaws(base::SignalLaw stiffness, base::SignalLaw damping, base::SignalLaw free)
      : stiffness_(std::move(stiffness)), damping_(std::move(damping)), free_(std::move(free)) {
    is_constant_ = stiffness_.is_constant() && damping_.is_constant() && free_.is_constant();
    if (is_constant_) numbers_ = find(0.0, {});
  }

  /// @param signals t and the values of all signals; may be empty where uses_signals() is false
  SpringNumbers at(double t, std::span<const double> signals) const {
    return is_constant_ ? numbers_ : find(t, signals);
  }
  bool is_constant() const { return is_constant_; }
  bool uses_signals() const {
    return stiffness_.uses_signals() || damping_.uses_signals() || free_.uses_signals();
  }
  /// Whether what the spring stores depends on more than its motion.
  bool drives_energy() const { return !stiffness_.is_constant() || !free_.is_constant(); }

 private:
  SpringNumbers find(double t, std::span<const double> signals) const {
    return {std::max(0.0, stiffness_.value(t, signals)), std::max(0.0, damping_.value(t, signals)),
            free_.value(t, signals)};
  }

  base::SignalLaw stiffness_, damping_, free_;
  SpringNumbers numbers_;
  bool is_constant_ = true;
};

}  // namespace buckens::loads
