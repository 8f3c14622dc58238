// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/results/run_summary.h"
#include "buckens/stepping/stepper.h"

namespace buckens::analysis {

/// Measures what the bodies' levels of inertial coupling leave out, and moves bodies with `auto` up
/// when it becomes too much.
///
/// A body moves up between steps, never down: to `first-order` if the terms that this leaves out
/// stay below the tolerance, otherwise to `full`. Terms are judged by their largest share in ten
/// steps, together with (|w|/ω₁)² and |ẇ|/ω₁²; a body without joints moves to `full` once |w|
/// exceeds 0.03 ω₁, because its spin about the middle axis is unstable. With different terms the
/// same motion has different accelerations: they are recomputed, energy and momentum jump by what
/// was neglected, and the jump is reported.
class CouplingWatch {
 public:
  CouplingWatch(const model::Model& model, const dynamics::MassMetric& metric,
                std::vector<int> rows_in_use);

  /// Lowest elastic ω of a body [rad/s].
  void set_lowest_frequency(std::size_t body, double omega) { bodies_[body].omega = omega; }

  /// Chooses levels for the start.
  void start(const stepping::Stepper& stepper, model::State& state);
  /// To be called after each step.
  void after_step(const stepping::Stepper& stepper, model::State& state);

  /// Number of products with stiffness or damping matrices of meshes so far: none after steps with
  /// a known balance of loads, see stepping::Stepper::has_balance().
  long num_products() const { return products_; }

  /// Level, its changes and the largest neglected share of each body.
  void fill(const model::State& state, results::RunSummary& summary) const;

  /// Saves or restores what later values depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Watched {
    bool is_automatic = false;
    bool is_supported = false;
    double tolerance = 0.01;
    double omega = 0;           // 0: unknown
    double window = 0;          // largest share since the last decision
    double neglected = 0;       // largest share at the level in use, over the run
    body::CouplingTerms first;  // at the start
    std::vector<std::string> changes;
  };

  bool is_measured(const Watched& body, const model::BodyState& state) const;
  /// What a body would leave out with these terms.
  double measure(std::size_t b, const stepping::Stepper& stepper, const model::State& state,
                 const body::CouplingTerms& kept);
  /// Terms that the motion requires, at least those in use.
  body::CouplingTerms needed(std::size_t b, const stepping::Stepper& stepper,
                             const model::State& state);
  /// @return whether any body moved up
  bool decide(const stepping::Stepper& stepper, model::State& state);

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  std::vector<int> rows_in_use_;
  std::vector<Watched> bodies_;
  long steps_ = 0;
  long products_ = 0;
};

}  // namespace buckens::analysis
