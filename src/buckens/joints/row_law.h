// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// Everything one scalar constraint g(X_F, X_M, t) = 0 says at one configuration.
///
///     ġ = J V + g_t,      g̈ = J V̇ + bias                                   FM (20), (34)
///
/// V holds the twists of both markers (see PairRow). The multiplier λ of the row acts on the
/// markers with the wrench Jᵀλ.
struct RowValue {
  double g = 0;    ///< residual: [m] for point rows, [-] for direction rows
  double g_t = 0;  ///< partial time derivative of g
  spatial::PairRow J = spatial::PairRow::Zero();
};

/// A constraint between two markers that remembers something from step to step, such as whole
/// turns.
///
/// What it remembers is part of the state of the mechanism (model::RowMemory), from which it is
/// handed in as `states`, num_states() numbers as at the start of the step; null where nothing is
/// known yet: then all are zero.
class RowLaw {
 public:
  virtual ~RowLaw() = default;

  virtual int num_states() const = 0;
  /// Whether it takes a moment of the second marker; of the first it always does.
  virtual bool turns_second() const { return true; }
  /// Whether its residual is a length, or without dimension.
  virtual bool is_length() const { return true; }
  /// Whether it holds rates that are those of no position, so that its residual is always zero.
  virtual bool holds_rates_only() const { return false; }
  virtual RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                            const double* states) const = 0;
  /// Part of g̈ that does not come from the accelerations of the bodies' coordinates.
  virtual double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
                      const double* states) const = 0;
  /// What is remembered at the end of a step.
  /// @param before may be null, @param after may be `before`
  virtual void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
                      const double* before, double* after) const = 0;
  /// What is remembered when an event attaches the joint: it looks anew. @param states as before
  virtual void attach(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      double* states) const {
    std::fill_n(states, num_states(), 0.0);
    follow(F, M, 0.0, nullptr, states);
  }
};

}  // namespace buckens::joints
