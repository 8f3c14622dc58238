// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// All terms of a scalar constraint g(X_F, X_M, t) = 0 at one configuration.
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

/// A constraint between two markers that has memory from step to step, such as the number of whole
/// turns.
///
/// Its memory is part of the state of the mechanism (model::RowMemory). It is passed as `states`:
/// num_states() numbers at the start of the step. Null means that they are not yet known and all
/// zero. t is the instant of the motions, which may lie within the step [s].
class RowLaw {
 public:
  virtual ~RowLaw() = default;

  virtual int num_states() const = 0;
  /// Whether it transmits a moment to the second marker; to the first it always does.
  virtual bool turns_second() const { return true; }
  /// Whether its residual is a length rather than dimensionless.
  virtual bool is_length() const { return true; }
  /// Whether it constrains rates only (non-holonomic), so that its residual is always zero.
  virtual bool holds_rates_only() const { return false; }
  virtual RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                            double t, const double* states) const = 0;
  /// Part of g̈ that is independent of the accelerations of the bodies' coordinates.
  virtual double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
                      double t, const double* states) const = 0;
  /// Updates the memory at the end of a step.
  /// @param before may be null, @param after may be `before`
  /// @throws StepTooLong if turns cannot be counted
  virtual void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
                      double t, const double* before, double* after) const = 0;
  /// Resets the memory when an event attaches the joint. @param states as before
  virtual void attach(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                      double* states) const {
    std::fill_n(states, num_states(), 0.0);
    follow(F, M, 0.0, t, nullptr, states);
  }
};

}  // namespace buckens::joints
