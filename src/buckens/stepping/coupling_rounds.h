// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// Decides in a step whether the inertial coupling is near enough to what the step was computed
/// with, or another round follows (docs/theory/05-time-integration.md, section 5).
class CouplingRounds {
 public:
  /// Distance of the coupling of all bodies from the one used.
  struct Gap {
    bool is_settled = true;  ///< within the tolerance
    double change = 0;       ///< relative, the largest
    double motion = 0;       ///< caused by it, relative to the model's length
  };
  enum class Verdict { ends, goes_on, fails };

  explicit CouplingRounds(const StepSettings& settings) : settings_(settings) {}
  /// @param solves rounds with solves so far in the step
  Verdict judge(const Gap& gap, int solves);

 private:
  const StepSettings& settings_;
  int rounds_ = 0;
  double last_change_ = -1;  // none yet
};

}  // namespace buckens::stepping
