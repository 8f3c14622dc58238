// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::analysis {

/// Collects how far joints were open during a run, and says whether that spoils its results.
class JointTrust {
 public:
  explicit JointTrust(const model::Model& model) : model_(model) {}

  /// After each step. Cost: one pass over the bodies.
  void add_step(const stepping::StepReport& report, const model::State& state);

  /// Largest residual of position of all rows, lengths as parts of the model's length [-].
  double opening() const { return opening_; }
  /// The same of velocity [1/s].
  double opening_rate() const { return opening_rate_; }

  /// A reason to doubt the results; empty: none. Joints may be open by a millionth of the model's
  /// length, and their velocities by 1e-4 of the largest there were, unless that comes to less than
  /// a millionth of the length over the whole run.
  /// @param duration of the run [s]
  std::string doubt(double duration) const;

  /// Saves what was collected so far, or takes it back. @throws InputError where it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  const model::Model& model_;
  double opening_ = 0, opening_rate_ = 0;
  int most_open_row_ = -1;
  double speed_ = 0;  // largest of all bodies, lengths as parts of the model's length [1/s]
};

/// What of an energy balance that does not close no smaller step would mend: the bodies whose
/// equations leave something out, each with what it is.
class EnergyTrust {
 public:
  explicit EnergyTrust(const model::Model& model)
      : model_(model), leaves_out_(model.bodies.size(), false) {}

  /// At each record: levels may change during a run.
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

/// What to say of a body that spins fast against its lowest elastic frequency, to which linear
/// elasticity owes (|w|/ω₁)² of its stiffness: a warning above 0.1, doubt above 0.3.
/// @param ratio |w|/ω₁
std::string describe_spin(const std::string& body, double ratio);
inline constexpr double kFastSpin = 0.1;
inline constexpr double kDoubtedSpin = 0.3;

}  // namespace buckens::analysis
