// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/signals.h"
#include "buckens/results/recorder.h"

namespace buckens::analysis {

/// Signals that take the value of a sensor at the ends of steps and hold it over the next one.
class HeldReadings {
 public:
  /// @throws InputError naming the components of a sensor of which none, or another, is asked for
  HeldReadings(const model::BuiltModel& built, const results::Recorder& recorder);

  bool empty() const { return readings_.empty(); }
  /// Reads at t = 0; blocks and samples begin with these values.
  void start(results::Recorder& recorder, const results::WorkBalance& work, model::State& state);
  /// Reads at the end of a step, then takes the samples of that instant.
  /// @param before the state at the start of the step
  /// @return whether there is anything to read
  bool follow(results::Recorder& recorder, const results::WorkBalance& work,
              const model::State& before, model::State& state);

 private:
  void read(results::Recorder& recorder, const results::WorkBalance& work,
            const model::State& state);

  const model::BuiltModel& built_;
  std::vector<results::Recorder::SensorValue> readings_;
  std::vector<dynamics::StateChange> changes_;  // states of their blocks, one for each
};

}  // namespace buckens::analysis
