// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::analysis {

/// Collects the residuals of joints during a run, and judges whether they spoil its results.
class JointTrust {
 public:
  explicit JointTrust(const model::Model& model) : model_(model) {}

  /// To be called after each step. Cost: one pass over the bodies.
  void add_step(const stepping::StepReport& report, const model::State& state);

  /// Largest position residual of all rows, lengths as fractions of the model's length [-].
  double opening() const { return opening_; }
  /// The same for velocity [1/s].
  double opening_rate() const { return opening_rate_; }

  /// A reason to doubt the results; empty: none. Admissible are a millionth of the model's length,
  /// and for velocities 1e-4 of the largest in the run, or less than a millionth of the length over
  /// the whole run.
  /// @param duration of the run [s]
  std::string doubt(double duration) const;

  /// Saves or restores what was collected so far. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  const model::Model& model_;
  double opening_ = 0, opening_rate_ = 0;
  int most_open_row_ = -1;
  double speed_ = 0;  // largest of all bodies, lengths as parts of the model's length [1/s]
};

/// Causes of an energy error that a smaller step cannot remedy: the bodies whose equations leave
/// something out, and what that is.
class EnergyTrust {
 public:
  explicit EnergyTrust(const model::Model& model)
      : model_(model), leaves_out_(model.bodies.size(), false) {}

  /// To be called at each record: levels may change during a run.
  void add_record(const model::State& state);

  /// A reason to doubt the results; empty: none.
  /// @param error of the balance, relative to the energy involved
  std::string doubt(double error) const;

  /// As JointTrust::visit_saved.
  void visit_saved(const base::SaveVisit& visit);

 private:
  const model::Model& model_;
  std::vector<bool> leaves_out_;  // per body
};

/// Verdict on a body that spins fast relative to its lowest elastic frequency, for which linear
/// elasticity errs by (|w|/ω₁)² of the stiffness: a warning above 0.1, doubt above 0.3.
/// @param ratio |w|/ω₁
std::string describe_spin(const std::string& body, double ratio);
inline constexpr double kFastSpin = 0.1;
inline constexpr double kDoubtedSpin = 0.3;

}  // namespace buckens::analysis
