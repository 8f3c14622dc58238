// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "buckens/analysis/simulation/deformation_limits.h"
#include "buckens/analysis/simulation/touch_watch.h"
#include "buckens/analysis/simulation/trust.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/run_summary.h"
#include "buckens/stepping/time_march.h"

namespace buckens::analysis {

/// Collects what the summary of a run reports.
class RunStatistics {
 public:
  /// @param pool shares the work of records, or null; outlives this object
  explicit RunStatistics(const model::BuiltModel& built, TaskPool* pool = nullptr);

  /// Lowest elastic ω of a body [rad/s]; without it the body's spin is not judged.
  void set_lowest_frequency(std::size_t body, double omega) { lowest_frequency_[body] = omega; }

  void add_step(const stepping::StepReport& report, const model::State& state);
  /// To be called after each step. @param of_loads what each load holds at its end, @param h [s]
  void add_touches(std::span<const dynamics::LoadPower> of_loads, double h) {
    touches_.add_step(of_loads, h);
  }
  /// To be called at each record: residual of the sieve, rotations inside bodies, energy error.
  /// @param balance E − E₀ − W + D [J], @param scale energy involved so far [J]; the largest
  /// balance is divided by the largest scale of the run
  void add_record(const model::State& state, double balance, double scale);

  /// Fills counts, residuals, energy error and trust.
  void fill(const stepping::TimeMarch& march, results::RunSummary& summary) const;

  /// Saves or restores what was collected so far. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  /// Warns if |ω| is no longer small against the lowest elastic frequency, unless axial forces
  /// stiffen the body.
  void judge_spin(std::size_t b, results::RunSummary& summary) const;
  void judge_shape(const model::WholeBody& whole, std::size_t most_bent,
                   const DeformationMeasure& found, results::RunSummary& summary) const;
  double spin_ratio(std::size_t b) const;
  /// One entry per body of the model file; the parts of a divided body are summed up.
  void add_whole(const model::WholeBody& whole, const stepping::StepLadder& ladder,
                 results::RunSummary& summary) const;

  const model::BuiltModel& built_;
  TaskPool* pool_;
  long steps_ = 0;
  long iterations_ = 0;
  long most_iterations_ = 0;
  long repeated_solves_ = 0;  // steps with more than one large solve
  long undecided_steps_ = 0;  // that took the last stands of rigid rows
  long impacts_ = 0;
  long steps_with_near_impulses_ = 0;  // see stepping::StepReport
  long jammed_impacts_ = 0;            // that friction kept from rebounding
  double impact_loss_ = 0;             // [J]
  results::Residuals residuals_;
  JointTrust joints_;
  EnergyTrust energy_;
  TouchWatch touches_;
  bool is_finite_ = true;  // of all energies so far
  double largest_balance_ = 0;
  double energy_scale_ = 0;
  std::vector<double> lowest_frequency_;                    // per body [rad/s], 0 if unknown
  std::vector<double> largest_spin_;                        // per body, |ω| [rad/s]
  std::vector<std::unique_ptr<DeformationLimits>> limits_;  // per body, none for rigid ones
  std::vector<DeformationMeasure> deformation_;             // per body, largest
};

}  // namespace buckens::analysis
