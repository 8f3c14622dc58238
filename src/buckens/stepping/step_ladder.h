// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "buckens/stepping/stepper.h"

namespace buckens::stepping {

/// Steppers for steps h, h/2, h/4, …: factorised when first needed, and kept.
///
/// Memory is bounded: when a new one is added and more than Limits::most_kept would be kept, or
/// their factors would have more than Limits::most_entries numbers in total, the least recently
/// used are dropped. The last used and the new one are always kept.
class StepLadder {
 public:
  static constexpr int kMostRung = 20;
  struct Limits {
    std::size_t most_kept = 8;
    double most_entries = 1.25e8;  ///< of all factors together: 1 GB
  };

  /// Factorises for the longest step. @param settings `step` is the longest
  StepLadder(const model::Model& model, const StepSettings& settings, std::vector<int> rows_in_use,
             const Limits& limits);
  StepLadder(const model::Model& model, const StepSettings& settings, std::vector<int> rows_in_use)
      : StepLadder(model, settings, std::move(rows_in_use), Limits{}) {}

  /// Stepper for steps h·2⁻ᵏ. The reference is valid until the next call.
  Stepper& rung(int k);
  /// The stepper that rung() returned last.
  Stepper& latest();
  /// h·2⁻ᵏ [s]
  double step(int k) const;

  /// Of all rungs together, including dropped ones.
  SolveCounts counts(std::size_t body) const;
  StepSeconds seconds() const;
  /// Factorisations done for one rung, all bodies together: one for bodies that share a factor,
  /// none for reduced ones; again each time a dropped rung is needed again.
  long factorisations(int k) const;
  /// Rungs currently kept.
  std::size_t num_kept() const { return rungs_.size(); }

  /// Saves or restores what later steps depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Rung {
    int k;
    long last_used;
    std::unique_ptr<Stepper> stepper;
  };
  std::unique_ptr<Stepper> make_stepper(int k);
  void take_rungs(const std::vector<int>& rungs, const std::vector<long>& last_used);
  void make_room(double entries);
  void retire(const Stepper& stepper);

  const model::Model& model_;
  StepSettings settings_;
  linalg::SharedStore vectors_;  // of bodies, for all rungs: states of one go on in the next
  std::vector<int> rows_in_use_;
  Limits limits_;
  std::vector<Rung> rungs_;
  std::vector<long> factorisations_;  ///< per k
  long uses_ = 0;
  std::vector<SolveCounts> retired_counts_;  ///< per body
  StepSeconds retired_seconds_;
};

}  // namespace buckens::stepping
