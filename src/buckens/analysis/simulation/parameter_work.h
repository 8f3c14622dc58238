// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/dynamics/signals.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// What springs gain as their parameters follow time and signals: ∫ ∂U/∂p ṗ dt over the steps of a
/// run, U(x, p) being the energy that a spring stores.
///
/// Over a step from x₀, p₀ to x₁, p₁ it is ½ (U(x₀, p₁) − U(x₀, p₀) + U(x₁, p₁) − U(x₁, p₀)), whose
/// error is of order h² like that of the steps. Where parameters jump at the end of a step, by
/// samples, p₁ is that before the jump, and what the jump gives at x₁ comes on top, exactly.
/// Theory: docs/theory/24-control.md §7.
class ParameterWork {
 public:
  ParameterWork(const model::Model& model, const model::State& start);

  /// Work of one load.
  struct Share {
    std::size_t load;
    double work;  ///< [J]
  };
  /// Of the step between two states.
  std::span<const Share> over_step(const model::State& before, const model::State& state);
  /// Of a jump of parameters in the last state.
  std::span<const Share> of_jump(const model::State& state);
  /// To be called when the work of a jump is known already.
  void restart(const model::State& state) { of_jump(state); }

  bool empty() const { return shares_.empty(); }

  void visit_saved(const base::SaveVisit& visit);

 private:
  /// Energy of the load of a share in the position of one state with the signals of another
  /// instant.
  double stored(std::size_t share, const model::State& at,
                const std::vector<dynamics::BodyMotion>& motions, double t,
                const std::vector<double>& signals) const;

  const model::Model& model_;
  std::vector<Share> shares_;
  std::vector<int> groups_;     ///< contact group that the load of a share is, −1: none
  std::vector<double> stored_;  ///< of each at the last state [J]
  dynamics::SignalValues end_;
};

}  // namespace buckens::analysis
