// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "buckens/analysis/simulation/damping_work.h"
#include "buckens/analysis/simulation/friction_work.h"
#include "buckens/analysis/simulation/parameter_work.h"
#include "buckens/base/saved_values.h"
#include "buckens/dynamics/joint_set.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/results/energy_parts.h"
#include "buckens/results/observation.h"
#include "buckens/results/run_summary.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::analysis {

/// Integrates the work of loads, drives and dampers over the steps of a run: trapezoidal rule,
/// so its error is of order h² like that of the steps. Dissipation in meshes comes from
/// DampingWork, that of friction in joints, whose forces change their sign within steps, from
/// FrictionWork. Also keeps a separate account of each load, drive, damped body and impact; these
/// add up to the total within rounding.
class WorkAccount {
 public:
  /// @param holds_at_states whether states satisfy the equations of motion, see DampingWork
  WorkAccount(const model::Model& model, const model::State& start, bool holds_at_states = false);

  /// Adds the work between the last state and this one.
  /// @param before the last state: if samples are taken at the end of the step, what follows them
  ///        jumps after it; null: nothing jumps
  /// @param report of the step; null: friction in joints by the trapezoidal rule, too
  void add(const model::State& state, const model::State* before = nullptr,
           const stepping::StepReport* report = nullptr);
  /// The same for a step with impacts: rates jump within it, so those at its ends do not determine
  /// the displacement, and the power of loads is formed with the mean rates.
  /// @param before the last state, @param impacts energy taken by the impacts of the step
  void add_impacts(const model::State& before, const model::State& state,
                   const stepping::StepReport& impacts);

  /// Adds what springs gained over the same step as their parameters followed time and signals.
  void add_parameters(const model::State& before, const model::State& state) {
    add_shares(parameters_.over_step(before, state));
  }
  /// To be called when signals of the last state have jumped.
  void take_jump(const model::State& state) { add_shares(parameters_.of_jump(state)); }

  /// To be called when accelerations of the last state have jumped with forces, see ForceJump.
  /// @param signals t and the values of all signals before the jump
  void take_force_jump(const model::State& state, const std::vector<double>& signals) {
    friction_->jump(state, signals);
  }

  /// To be called when pairs have come near or gone away: the loads of the model and what the last
  /// state remembers of them have changed.
  void follow_pairs(const model::State& state);

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
  /// What each load holds and does at the last state; one entry per Model::loads.
  std::span<const dynamics::LoadPower> of_loads() const { return loads_before_; }
  /// The order of results::WorkBalance::parts.
  const results::EnergyParts& parts() const { return parts_; }
  /// All that is not zero, up to this state.
  results::EnergyAccount account(const model::State& state) const;
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
  /// The values of signals at the end of a step before the samples of that instant are taken; null
  /// where nothing is sampled. Valid until the next call.
  const std::vector<double>* unsampled(const model::State& before, const model::State& state);
  /// Leaves the forces at the state in forces_, and powers of loads with them.
  /// @param signals null, or their values in place of those of the state
  void find_powers(const model::State& state, Powers& out,
                   const std::vector<double>* signals = nullptr);
  /// Of loads and dampers at a configuration, with other velocities.
  Powers powers_at(const model::State& state, const std::vector<dynamics::BodyMotion>& motions,
                   const std::vector<double>* signals = nullptr);
  /// Adds the step that ends with now_.
  /// @param loads mean power of loads and dampers over the step
  /// @param impacts null: none
  void add_step(const model::State& state, const Powers& loads, const stepping::StepReport* impacts,
                RatesAtEnd rates);
  /// Adds the step to the parts: means_ of loads over it, impacts, and what drives do.
  /// @param first,last multipliers at its start and end
  void add_parts(double h, const linalg::Vector& first, const linalg::Vector& last,
                 const linalg::Vector& g_t, const stepping::StepReport* impacts);
  void add_shares(std::span<const ParameterWork::Share> shares);
  double& part(std::size_t k) { return work_.parts[static_cast<Eigen::Index>(k)]; }
  /// Power of friction in contacts that closed in an impact of this step [W]: within the step it is
  /// part of the loss of the impact. Takes it out of means_.
  double landed(const model::State& state);
  /// Puts what friction in joints has lost over a step in the place of its mean power in means_.
  /// @param h of the step [s], @param blows see FrictionWork::add()
  /// @return what this adds to the mean power [W]
  double take_friction(const model::State& state, const stepping::StepReport* report, double h,
                       const FrictionWork::Blows* blows = nullptr);

  const model::Model& model_;
  dynamics::JointSet joints_;
  std::vector<DampingWork> meshes_;
  ParameterWork parameters_;
  std::optional<FrictionWork> friction_;
  bool has_samples_;
  dynamics::SignalValues unsampled_;
  dynamics::Forces forces_;
  dynamics::JointResiduals residuals_;
  Powers before_, now_;
  std::vector<dynamics::BodyMotion> motions_;
  linalg::Vector laws_before_;  ///< RowMemory::laws of the last state, of models with impacts
  double t_ = 0;
  linalg::Vector lambda_before_, lambda_start_;  ///< as carried; at the last state
  linalg::Vector lambda_end_;                    ///< at the present one
  double lambda_time_ = 0;                       ///< instant of lambda_before_
  results::WorkBalance work_, work_before_;
  double turnover_ = 0;
  results::EnergyParts parts_;
  std::vector<dynamics::LoadPower> loads_before_;  ///< at the last state
  std::vector<dynamics::LoadPower> means_;         ///< over the step
  linalg::Vector parts_start_;                     ///< work_.parts at the start
  dynamics::Energy start_;
};

}  // namespace buckens::analysis
