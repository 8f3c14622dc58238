// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/dynamics/joint_set.h"
#include "buckens/model/state.h"
#include "buckens/stepping/coupling_rounds.h"
#include "buckens/stepping/forecast.h"
#include "buckens/stepping/iteration_end.h"
#include "buckens/stepping/row_watch.h"
#include "buckens/stepping/step_settings.h"
#include "buckens/stepping/strand/loads.h"
#include "buckens/stepping/strand/mechanism.h"

namespace buckens::stepping {

/// Steps of a StrandMechanism: the same equations and criteria as LargeStep, SmallNewton and
/// LaggedCoupling, for eight bodies at once. The result is that of the general route to rounding
/// (stepping/test/strand_step_test.cpp), and depends on the state alone.
///
/// What is rare is left to the general route: takes() tells beforehand, and step() gives up where
/// an iteration does not converge, a body turns by more than 1 rad in a step, or joints come near
/// a dead centre. The step is then to be taken again from the same state.
class StrandStep {
 public:
  /// Null if the model is none that StrandMechanism can lay out.
  static std::unique_ptr<StrandStep> make(const model::Model& model, const StepSettings& settings,
                                          const Scheme& scheme,
                                          const StrandMechanism::Operators& operators);
  StrandStep(const model::Model& model, const StepSettings& settings, const Scheme& scheme,
             const StrandMechanism::Operators& operators);

  /// Whether a step from this state can be tried. @param rows_in_use of λ, ascending
  bool takes(const model::State& state, const std::vector<int>& rows_in_use) const;
  /// @param next state at the end, except for memory; its buffers are reused
  /// @return false if the general route has to take this step; `next` is then undefined
  bool step(const model::State& state, model::State& next, StepReport& report);

  /// Motions at the end of the last step, with row values of bodies that coordinates of the model
  /// belong to.
  const std::vector<dynamics::BodyMotion>& motions_at_end() const { return motions_; }
  /// Large solves of a body so far.
  long solves(std::size_t body) const { return solves_[body]; }

 private:
  using Change = IterationEnd::Change;
  /// Everything of a block at the start of a step, and moves it to where that leads.
  template <class S>
  void load_block(const model::State& state, std::size_t block);
  template <class S>
  void load_body(const model::State& state, std::size_t b);
  template <class S>
  void load_mesh(const model::State& state, std::size_t b);
  template <class S>
  void apply_forecast(const model::State& state);
  template <class S>
  double rounding_length() const;
  template <class S>
  bool compute(const model::State& state, StepReport& report);
  template <class S>
  void write(const model::State& state, model::State& next);
  template <class S>
  void write_mesh(const model::State& state, std::size_t b, model::BodyState& out) const;
  template <class S>
  CouplingRounds::Gap compare_coupling();
  template <class S>
  void put_multipliers();

  /// Loads everything, and forms the matrix where it leads. @return false if a body turns too far
  template <class S>
  bool prepare(const model::State& state);
  // Turns of a sweep: work on one block.
  void move_body(std::size_t block);
  void evaluate_joint(std::size_t block);  ///< residuals of rows, loads on markers
  /// Loads on bodies, and what they leave open if that is to be found.
  /// @param state at the start of the step
  void balance_bodies(const model::State& state, bool finds_residuals);
  bool turns_too_far() const;
  /// One iteration; bodies and residuals of joints are then where it leads. @return false if the
  /// motion has diverged
  bool move(StepReport& report, Change& change);
  /// @param goes_on whether it may leave to another round what is small
  bool settle(const model::State& state, StepReport& report, Change change, bool goes_on = false);
  /// Closes what settle() has left, where no other round follows.
  bool close(const model::State& state, StepReport& report, Change& change);
  bool is_balanced(double motion) const;
  model::Coupling& extrapolated(const model::State& state, std::size_t b);

  const model::Model& model_;
  StepSettings settings_;
  Scheme scheme_;
  StrandMechanism mechanism_;
  StrandLoads loads_;
  const strand::Kernels& kernels_;
  Forecast forecast_;
  RowWatch watch_;
  std::vector<int> all_rows_;
  std::vector<char> is_touched_;  // bodies that coordinates belong to
  dynamics::JointResiduals residuals_;
  linalg::Vector lambda_, E_, X_;
  IterationEnd ending_;
  bool had_rounds_ = false, has_left_open_ = false;
  double motion_ = 0;    // of the step, at the last iteration [m]
  double furthest_ = 0;  // largest square of half an angle by which something turns
  double open_ = 0;      // size of the residuals of bodies
  std::vector<long> solves_;
  std::vector<dynamics::BodyMotion> motions_;
  model::Coupling coupling_;  // scratch
};

}  // namespace buckens::stepping
