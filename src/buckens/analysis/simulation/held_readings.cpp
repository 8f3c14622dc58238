// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/held_readings.h"

#include <utility>

#include "buckens/dynamics/circumstances.h"
#include "buckens/results/state_interpolation.h"

namespace buckens::analysis {

HeldReadings::HeldReadings(const model::BuiltModel& built, const results::Recorder& recorder)
    : built_(built) {
  const auto& sensors = built.description.output.sensors;
  for (const model::Signal& signal : built.model.signals.all) {
    for (std::size_t k = 0; signal.held && k < sensors.size(); ++k) {
      if (sensors[k].name != signal.held->sensor) continue;
      readings_.push_back({k, recorder.find_component(k, signal)});
      changes_.push_back({signal.first_state, 0.0});
    }
  }
}

void HeldReadings::read(results::Recorder& recorder, const results::WorkBalance& work,
                        const model::State& state) {
  const std::vector<double> values = recorder.read(state, work, readings_);
  for (std::size_t k = 0; k < values.size(); ++k) changes_[k].value = values[k];
}

void HeldReadings::start(results::Recorder& recorder, const results::WorkBalance& work,
                         model::State& state) {
  if (readings_.empty()) return;
  read(recorder, work, state);
  dynamics::start_signals(built_.model, dynamics::motions_of(built_.model, state), state.t,
                          state.memory, changes_);
}

bool HeldReadings::follow(results::Recorder& recorder, const results::WorkBalance& work,
                          const model::State& before, model::State& state) {
  if (readings_.empty()) return false;
  // λ of a step may refer to an instant within it; sensors have it at its end.
  linalg::Vector at_end = results::multipliers_at(before, state, state.t);
  std::swap(state.lambda, at_end);
  read(recorder, work, state);
  std::swap(state.lambda, at_end);
  dynamics::change_states(built_.model, dynamics::motions_of(built_.model, state),
                          dynamics::circumstances_of(state), changes_, state.memory,
                          dynamics::Samples::are_due);
  return true;
}

}  // namespace buckens::analysis
