// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/model/state.h"
#include "buckens/stepping/body_step.h"

namespace buckens::stepping {

/// Initial guess of a step's iteration: multipliers and accelerations of the frames, extrapolated
/// by parabolas through the last three steps. If a motion is smooth, this saves iterations compared
/// with the accelerations of the last step alone.
///
/// It is a guess only: residuals, matrix and directions of the iteration do not depend on it. It
/// depends on the state alone, so that a repeated step or a continued run finds the same guess bit
/// for bit.
class Forecast {
 public:
  /// @param L length by which angles count [m]
  Forecast(const Scheme& scheme, double L) : scheme_(scheme), L_(L) {}

  /// Whether the state holds three steps without a jump between them, and the first two would have
  /// predicted the accelerations of the third better than the second alone. Vibrations that the
  /// steps do not resolve are not extrapolated.
  bool foretells(const model::State& state) const;
  /// Weights of the state, of the step before it and of the one before that.
  using Parabola = std::array<double, 3>;
  Parabola parabola(const model::State& state) const;
  /// Forecast accelerations of a frame.
  static Vector6 acceleration(const model::State& state, const Parabola& weights, std::size_t body);
  static void foretell_multipliers(const model::State& state, const Parabola& weights,
                                   linalg::Vector& lambda);
  /// Changes increments of the frames and λ to the forecast ones.
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
