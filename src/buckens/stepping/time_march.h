// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/stepping/local_error.h"
#include "buckens/stepping/step_ladder.h"

namespace buckens::stepping {

/// How far to go and how long steps may be.
struct MarchSettings {
  double duration = 0;                      ///< instant of the end [s]
  double start = 0;                         ///< instant of the first step's beginning [s]
  long longest_steps = 1;                   ///< number of longest steps from start to end
  std::optional<ErrorTolerance> tolerance;  ///< controls the step; none: the longest throughout
  double given_step = 0;  ///< keeps its digits if longest_steps of it fill the run [s]
  int most_halvings = 8;  ///< of a step that fails, without tolerance
};

/// The longest step [s]: a given one that divides the run to rounding keeps its digits, as in runs
/// of other lengths.
double longest_step_of(const MarchSettings& march);

/// Steps of one length that were accepted.
struct RungUse {
  double step = 0;  ///< [s]
  long steps = 0;
  long factorisations = 0;  ///< all bodies together
};

/// Rejected steps.
struct MarchReport {
  long accepted = 0;
  long rejected = 0;  ///< error above the tolerance
  long failed = 0;    ///< not converged
};

/// Advances to the end of a run by steps h·2⁻ᵏ.
///
/// With a tolerance, k follows the estimated error of each step, which may use a share of the
/// tolerance in proportion to its length: in total they stay within the tolerance. While a step is
/// shortened for an event, such as the onset of a load, it keeps the share of the step that was
/// tried first; in the following steps this fades by halves. Without a tolerance k is 0. A step
/// that does not converge is repeated with half its length, at most most_halvings times, one that
/// is too long for what happens in it as often as that takes; afterwards the march returns to the
/// given step as soon as that fits the grid again. Steps of length h·2⁻ᵏ start at multiples of it,
/// so times are exact and the end is reached exactly.
class TimeMarch {
 public:
  static constexpr int kShortestRung = 20;  ///< h/2²⁰
  static constexpr int kEventRung = 4;      ///< on which events are located: h/2⁴

  using StepQuestion = std::function<bool(const model::State& before, const model::State& after)>;

  /// @param settings `step` is replaced by given_step or (duration − start) / longest_steps
  TimeMarch(const model::Model& model, StepSettings settings, std::vector<int> rows_in_use,
            const MarchSettings& march);

  /// One accepted step from `before` to `after`, preceded by as many rejected ones as it takes.
  /// `before` is not changed: rejected steps leave no trace.
  /// @throws NumericalError naming the joint or body that resists, or whose error stays too large
  /// @param holds_event whether a step contains an event whose instant matters: it is then repeated
  ///        with shorter steps, down to 1/16 of the longest, so that the event is at the end of one
  /// @param is_too_long whether a step is too long for what happened in it: it is then halved, down
  ///        to h/2²⁰, which is taken as it is
  StepReport advance(const model::State& before, model::State& after,
                     const StepQuestion& holds_event = {}, const StepQuestion& is_too_long = {});

  /// To be called where accelerations of `state`, the end of the last step, were found anew: the
  /// method begins with what its steps resolve of them (Stepper::filter_algorithmic), and what the
  /// error estimate knows of the past ends there.
  void restart(model::State& state);

  /// The same where a force has fallen within the last step, so that the method would carry on what
  /// is no more: it goes on with the accelerations of the end.
  void forget_force(model::State& state);

  bool is_controlled() const { return error_.has_value(); }
  bool is_done() const { return ticks_ >= end_; }
  /// Where it stands [s].
  double time() const;
  double longest_step() const { return ladder_.step(0); }
  /// Length of the step that advance() will try next [s].
  double next_step() const { return ladder_.step(k_); }
  /// Of the last step. The reference is valid until the next step.
  Stepper& stepper() { return ladder_.latest(); }
  /// The one of the longest steps. Replaces what stepper() returns until the next step.
  const Stepper& longest_stepper() { return ladder_.rung(0); }
  const StepLadder& ladder() const { return ladder_; }
  const MarchReport& report() const { return report_; }
  /// Rungs in use, from the longest step to the shortest.
  std::vector<RungUse> rungs() const;

  /// Saves or restores what later steps depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  int shortest() const { return error_ || has_deepened_ ? kShortestRung : march_.most_halvings; }
  bool fits(int k) const;
  bool is_admitted(const model::State& after, const Scheme& scheme);
  void shorten(int halvings);
  void choose_next();
  [[noreturn]] void give_up(const std::string& why) const;

  MarchSettings march_;
  StepLadder ladder_;
  const model::Model& model_;
  std::optional<LocalError> error_;
  ErrorEstimate estimate_;
  bool has_begun_ = false;
  bool has_restarted_ = false;  ///< at the end of the last step
  bool has_deepened_ = false;   ///< the step being tried is on a rung beyond most_halvings
  int k_ = 0;
  double spread_ = 0;         ///< time whose share of the tolerance the next step may use [s]
  long ticks_ = 0, end_ = 0;  ///< multiples of the shortest step
  MarchReport report_;
  bool has_rigid_rows_ = false;
  double rejected_ratio_ = 0;   ///< of the error, in the trial before of the step being tried
  std::vector<long> accepted_;  ///< per k
  std::string first_failure_;   ///< of the step being tried
  int first_failed_ = 0;        ///< its k
};

}  // namespace buckens::stepping
