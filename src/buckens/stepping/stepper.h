// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/coupling_rounds.h"
#include "buckens/stepping/factor_group.h"
#include "buckens/stepping/forecast.h"
#include "buckens/stepping/friction_of_step.h"
#include "buckens/stepping/impacts.h"
#include "buckens/stepping/neglected_terms.h"
#include "buckens/stepping/small_newton.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

class StrandStep;

/// Large-solve counts of one body.
struct SolveCounts {
  long factorisations = 0;
  long solves = 0;           ///< inside steps
  long recycled = 0;         ///< inside steps, combined from earlier solves
  long setup_solves = 0;     ///< for interface columns
  long iterations = 0;       ///< of the solves inside steps, where they iterate
  double solve_seconds = 0;  ///< the same, wall time
  double solver_bytes = 0;   ///< of a solver that iterates, with its matrix; the largest
};

/// Wall time of all steps so far, by phase [s].
struct StepSeconds {
  double large_solves = 0;  ///< right-hand sides, solves, sieve
  double newton = 0;        ///< frames and multipliers
  double completion = 0;    ///< thin products
};

/// Advances a mechanism by steps of one length with one factorisation per flexible body.
///
/// With several threads, bodies advance concurrently, and large solves are shared between two; the
/// result is bitwise the same. Bodies with equal matrices share one factor and solve together. Once
/// the first steps have been taken, a step allocates nothing at all, unless the joint rows in use
/// or its length change, or several simulations solve together.
///
/// One step, FM (37)–(43): a large solve per flexible body for the motion without joint forces; the
/// small Newton in frame coordinates and λ; a thin product to complete the nodal variables;
/// inertial coupling evaluated there, with a further solve if it changed by more than the outer
/// tolerance. Such solves are kept and combined in later steps, as long as each step goes on from
/// the end of the one before; without `kept_solves` a step depends on nothing but the state before.
class Stepper {
 public:
  /// Factorises. @param rows_in_use independent joint rows
  Stepper(const model::Model& model, const StepSettings& settings, std::vector<int> rows_in_use);
  ~Stepper();

  /// Advances `state` by one step. The previous step may have had another length.
  /// @throws StepFailure naming the joint or body that resists; `state` is then bitwise unchanged
  StepReport step(model::State& state) { return step(state, state); }
  /// The same into `after`, which may be `before`; its buffers are reused.
  StepReport step(const model::State& before, model::State& after);

  /// For the following steps, see SmallNewton::accept_last_stands().
  void accept_last_stands(bool accepts);
  /// For the following steps, see SmallNewton::decide_first().
  void decide_first(bool decides);
  /// Whether there are contacts for decide_first().
  bool has_rough_contacts() const { return newton_->has_rough_contacts(); }

  /// Threads for the following steps, ≥ 1.
  void use_threads(int threads);

  /// Whether this model's small bodies step eight at a time.
  bool steps_side_by_side() const { return strand_ != nullptr; }
  SolveCounts counts(std::size_t body) const;
  /// What a flexible body would leave out at a state if it kept only these terms, see
  /// neglected_share(). No product with K or C is formed where has_balance() holds.
  double neglected(std::size_t body, const model::State& state,
                   const body::CouplingTerms& kept) const;
  /// Whether the loads on a body at a state are known to satisfy its equations of motion: at the
  /// end of the last step by a method that satisfies them there, with the terms of that step.
  bool has_balance(std::size_t body, const model::State& state,
                   const body::CouplingTerms& kept) const;
  /// Why the solver of a body, chosen automatically, is what it is; empty if it was not.
  std::string why_solver(std::size_t body) const;
  /// Lowest elastic frequency of a flexible body [rad/s], see lowest_frequency.h.
  double lowest_frequency(std::size_t body);
  const StepSeconds& seconds() const { return seconds_; }
  /// Numbers in the factors of all bodies: the memory that this stepper needs.
  double factor_entries() const;
  /// Bytes that one pass over the factors of all bodies reads.
  double factor_bytes() const;
  /// Jump of the interface rates per impulse along the rows of the interface, k₀ N Y K̂⁻¹Nᵀ [1/kg],
  /// as the method would respond: without vibrations that the step does not resolve. Empty for
  /// bodies whose mesh does not move by itself.
  linalg::Matrix impulse_compliance(std::size_t body) const;
  /// Adds the same for all nodal rates.
  void add_impulse(std::size_t body, const linalg::Vector& impulse,
                   linalg::NodalVector& rates) const;
  /// For algorithmic accelerations of meshes that equal the true ones, as after these have been
  /// computed afresh: removes what the step does not resolve, if the method damps, (I9). One solve
  /// per mesh.
  void filter_algorithmic(model::State& state);
  /// Sets rates of meshes that strong damping reverses from step to step to their mean over the
  /// last one, (I11); this may open rows. Two solves per damped mesh. @return whether there are any
  bool take_mean_of_turning(const model::State& before, model::State& after);
  const Scheme& scheme() const { return scheme_; }
  /// Joint rows in use at the last step.
  const std::vector<int>& rows_in_use() const { return newton_->rows_in_use(); }
  /// How often the joint equations in use were changed.
  int num_row_selections() const { return newton_->num_selections(); }

  /// Saves or restores what later steps depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  /// How the solutions of a round were obtained.
  enum class Answers { none_asked, all_recycled, solved };
  StepReport take_step(const model::State& state, model::State& end);
  /// Makes what follows from the loads; again when pairs have come near or gone away, continuing
  /// from what was saved of it.
  void make_iteration(std::vector<int> rows_in_use);
  void follow_pairs();
  StepReport take_general_step(const model::State& state);
  /// @return false if the general route has to take this step
  bool take_strand_step(const model::State& state, StepReport& report);
  void start_bodies(const model::State& state);
  Answers free_responses(const model::State& state, int round);
  /// Keeps the solves of the last step if this one goes on from it; forgets all of them if not, so
  /// that steps that were rejected or taken back leave no trace.
  void recall_solves(const model::State& before);
  void finish_lesson(const model::State& end);
  void complete(const model::State& state);
  void take_over_coupling();
  void compute_round(const model::State& state, int round, StepReport& report);
  CouplingRounds::Gap compare_coupling(const model::State& state);
  /// The parts of a state besides bodies and memory.
  void form_next_instant(const model::State& state);
  void form_next_state(const model::State& state);
  /// Keeps what friction in joints has done, as it was last iterated.
  void take_friction(double t, StepReport& report);
  /// Applies the impacts of what has run into rigid stops, at the end of the step.
  void take_impacts(StepReport& report);
  void add_jump(std::size_t b, const BodyJump& jump, dynamics::BodyMotion& motion);
  /// Keeps shapes and rates of damped meshes before the jumps.
  void keep_before_blows();
  void group_factors();
  /// Calls f(b) for every body, in parallel where that pays; results must not depend on the order.
  template <class F>
  void for_bodies(F&& f);

  const model::Model& model_;
  StepSettings settings_;
  Scheme scheme_;
  std::vector<std::shared_ptr<BodyStepOperator>> operators_;  // equal small bodies have one
  std::vector<char> has_own_operator_;                        // not that of a body before
  std::unique_ptr<SmallNewton> newton_;
  std::vector<model::NearPair> pairs_;  // that newton_ and impacts_ were made for
  Forecast forecast_;
  bool forecasts_;  // no rows that come and go, which a forecast does not know
  std::unique_ptr<Impacts> impacts_;
  FrictionOfStep friction_;
  std::vector<dynamics::BodyMotion> at_start_;  // of the step, for impacts_
  std::vector<ShapeAndRates> before_blows_;     // per body, at the end of the last step with any
  std::unique_ptr<StrandStep> strand_;          // null: never
  std::vector<BodyStep> bodies_;
  std::vector<std::unique_ptr<FlexibleStep>> flexible_;  // null: rigid
  std::vector<FactorGroup> groups_;
  std::vector<LaggedCoupling::Gap> gaps_;  // per body
  std::unique_ptr<TaskPool> own_pool_;
  TaskPool* pool_ = nullptr;  // null with one thread
  model::State next_;
  linalg::Vector lambda_;  // of the current step
  double stepped_to_ = 0;  // end of the last step [s]
  bool has_stepped_ = false;
  bool has_lesson_ = false;    // solves of the last step, to be kept if the next goes on from it
  Eigen::Index num_dofs_ = 0;  // of all bodies
  std::size_t least_settled_ = 0;  // body with the largest change of coupling
  StepSeconds seconds_;
};

}  // namespace buckens::stepping
