// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/base/signal_law.h"

namespace buckens::joints {

/// The law that a drive follows: exactly one of the three, or none for a free slider.
struct DriveLaws {
  const std::optional<base::SignalLaw>&position, &rate, &acceleration;

  int num_given() const {
    return int{position.has_value()} + int{rate.has_value()} + int{acceleration.has_value()};
  }
  /// Whether it follows signals, so that there is no law of time.
  bool is_steered() const {
    for (const auto* law : {&position, &rate, &acceleration}) {
      if (*law && (*law)->uses_signals()) return true;
    }
    return false;
  }
  /// The motion as a law of time; integrals are 0 at t = 0. @pre !is_steered()
  base::TimeLaw of_time() const {
    if (rate) return base::TimeLaw::integral(rate->law);
    if (acceleration) return base::TimeLaw::integral(base::TimeLaw::integral(acceleration->law));
    return position ? position->law : base::TimeLaw();
  }
};

}  // namespace buckens::joints
