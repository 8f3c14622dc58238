// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/base/signal_law.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Watches the work of motors with a power limit.
///
/// A force that falls from its limit to P/|ξ̇| within a step, as from rest or where the motion turns
/// round, has acted through half of the step on its way: more work than the power allows. Such a
/// step is too long. Theory: docs/theory/24-control.md §1. Cost: two evaluations of each such motor
/// per step; nothing where there are none.
class PowerWatch {
 public:
  /// @param model outlives the watch
  /// @param carries whether the method carries forces at the start of a step through it
  PowerWatch(const model::Model& model, bool carries);

  /// Whether there are such motors.
  bool any() const { return !motors_.empty(); }
  /// Whether a motor that drives did noticeably more work in a step than its power allows.
  /// @param longest step of the run [s]: the scale of what is noticeable
  bool exceeds(const model::State& before, const model::State& after, double longest) const;

 private:
  struct Motor {
    std::size_t load = 0;
    const base::SignalLaw* power = nullptr;
  };

  const model::Model& model_;
  bool carries_;
  std::vector<Motor> motors_;
};

}  // namespace buckens::analysis
