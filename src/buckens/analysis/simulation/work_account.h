// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/simulation/damping_work.h"
#include "buckens/base/saved_values.h"
#include "buckens/dynamics/joint_set.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/results/observation.h"

namespace buckens::analysis {

/// Integrates the work of loads, drives and dampers over the steps of a run: trapezoidal rule,
/// so its error is of order h² like that of the steps. Dissipation in meshes comes from
/// DampingWork.
class WorkAccount {
 public:
  /// @param holds_at_states whether states satisfy the equations of motion, see DampingWork
  WorkAccount(const model::Model& model, const model::State& start, bool holds_at_states = false);

  /// Adds the work between the last state and this one.
  void add(const model::State& state);
  /// The same for a step in which something struck: rates jump within it, so those at its ends do
  /// not tell the way, and the power of loads is formed with the mean ones.
  /// @param before the last state, @param loss energy that the impacts took [J]
  void add_impacts(const model::State& before, const model::State& state, double loss);

  /// To be called when inputs of the last state were changed: the next step starts with them.
  void take_inputs(const model::State& state);

  /// To be called when an event has changed the last state.
  /// @param gained by springs and the like [J], @param lost in impacts [J]
  void take_event(const model::State& state, double gained, double lost);

  /// To be called when the motion goes on from here with other rates and forces.
  /// Cost: a product with K per damped mesh
  void restart(const model::State& state);

  const results::WorkBalance& work() const { return work_; }
  /// What work() was before the last add().
  const results::WorkBalance& work_before() const { return work_before_; }
  /// ∫|P| dt [J]: a measure of the energy that passed through the mechanism.
  double turnover() const { return turnover_; }
  /// Number of products with stiffness or damping matrices of meshes so far.
  long num_products() const;

  /// Saves or restores what later values depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Powers {
    double active = 0;   ///< of loads [W]
    double damping = 0;  ///< of dampers [W]
    linalg::Vector g_t;  ///< ∂g/∂t of the joints
  };
  /// Leaves the forces at the state in forces_.
  Powers powers(const model::State& state);
  /// Of loads and dampers at a configuration, with other velocities.
  Powers powers_at(const model::State& state, const std::vector<dynamics::BodyMotion>& motions);
  /// @param loads mean power of loads and dampers over the step
  void add(const model::State& state, const Powers& now, const Powers& loads, double impact_loss,
           RatesAtEnd rates);
  /// Power of friction in contacts that closed in an impact of this step: it is in the loss of the
  /// impact, and begins with the next step [W].
  double landed(const model::State& state) const;

  const model::Model& model_;
  dynamics::JointSet joints_;
  std::vector<DampingWork> meshes_;
  dynamics::Forces forces_;
  dynamics::JointResiduals residuals_;
  Powers before_;
  linalg::Vector laws_before_;  ///< RowMemory::laws of the last state, of models with impacts
  double t_ = 0;
  linalg::Vector lambda_before_, lambda_start_;  ///< as carried; at the last state
  double lambda_time_ = 0;                       ///< instant of lambda_before_
  results::WorkBalance work_, work_before_;
  double turnover_ = 0;
};

}  // namespace buckens::analysis
