// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/constraint_row.h"

namespace buckens::joints {

/// A row that couples where its markers are when an event attaches it: teeth mesh, belts grip and
/// nuts close where they have turned to meanwhile.
///
///     g = ḡ − ḡ₀                                                                            (R36)
///
/// with the residual ḡ of the row itself, and ḡ₀ that at which it was attached: its first state,
/// zero as placed. Behind it stand the states of the row itself.
class FoundRow final : public RowLaw {
 public:
  /// @param row of no law of time, @param period after which ḡ repeats, 0: it does not
  explicit FoundRow(ConstraintRow row, double period = 0.0);

  int num_states() const override { return 1 + row_.num_states(); }
  bool turns_second() const override { return row_.turns_second(); }
  bool is_length() const override { return row_.is_length(); }
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states) const override;
  void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
              double t, const double* before, double* after) const override;
  void attach(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
              double* states) const override;

 private:
  ConstraintRow row_;
  double period_;
};

}  // namespace buckens::joints
