// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/model/state.h"
#include "buckens/stepping/body_step.h"

namespace buckens::stepping {

/// First guess of a step's iteration: multipliers and accelerations of the frames as parabolas
/// through the last three steps. Where a motion is smooth, fewer iterations are needed from there
/// than from the accelerations of the last step alone.
///
/// It is a guess only: residuals, matrix and directions of the iteration know nothing of it. It
/// depends on the state alone, so that a step that is repeated, or a run that goes on, finds the
/// same to the last bit.
class Forecast {
 public:
  /// @param L length by which angles count [m]
  Forecast(const Scheme& scheme, double L) : scheme_(scheme), L_(L) {}

  /// Whether the state knows three steps without a jump between them, of which the first two would
  /// have told the accelerations of the third better than the second alone. Vibrations that steps
  /// do not resolve are not foretold.
  bool foretells(const model::State& state) const;
  /// Weights of what the state, the step before and the earlier one say in the forecast.
  using Parabola = std::array<double, 3>;
  Parabola parabola(const model::State& state) const;
  /// Accelerations of a frame as foretold.
  static Vector6 acceleration(const model::State& state, const Parabola& weights, std::size_t body);
  static void foretell_multipliers(const model::State& state, const Parabola& weights,
                                   linalg::Vector& lambda);
  /// Changes increments of the frames and λ to those foretold.
  /// @param bodies at the start of the step from `state`
  void apply(const model::State& state, std::vector<BodyStep>& bodies,
             linalg::Vector& lambda) const;

 private:
  Scheme scheme_;
  double L_;
};

/// Notes a step in the state at its end. @param before the state at its start
void note_past(const model::State& before, model::State& end);

}  // namespace buckens::stepping
