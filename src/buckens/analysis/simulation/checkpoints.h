// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>

#include "buckens/analysis/simulation/simulation.h"

namespace buckens::analysis {

/// Saves the state of a simulation every so often in wall time, between two steps.
///
/// Saving takes at most a twentieth of the time: where a state takes long to write, the interval
/// grows.
class Checkpoints {
 public:
  using Write = std::function<void(base::SavedValues)>;

  /// Follows the steps of the simulation from now on, and must outlive them.
  /// @param interval wall time between checkpoints [s]
  Checkpoints(Simulation& simulation, double interval, Write write);

 private:
  using Clock = std::chrono::steady_clock;
  void after_step();

  Simulation& simulation_;
  Clock::duration interval_;
  Write write_;
  Clock::time_point next_;
};

}  // namespace buckens::analysis
