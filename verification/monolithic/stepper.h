// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "verification/monolithic/ordered_lu.h"

#include "buckens/dynamics/forces.h"
#include "buckens/stepping/held_laws.h"
#include "buckens/stepping/rigid_rows.h"
#include "buckens/stepping/scheme.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::verification {

/// The slow alternative for a step, for tests: one sparse saddle-point system in all unknowns.
///
/// The unknowns are the increments of frames and nodal variables, the joint multipliers λ and the
/// frame multipliers Λ of FM (21), (28), and for the stabilised index-2 positions the corrections
/// of frames and nodal variables with their own multipliers E and Λ_η. The whole system is
/// assembled and factorised in each iteration:
///
///     W u − Gᵀλ = …     K̂ Δ + k K η − PΛ − NᵀGᵀλ = …     PᵀΔ = …     ġ(end) = 0
///     W κ − GᵀE = 0     K̂ η − PΛ_η − NᵀGᵀE = 0           Pᵀη = 0     g(end) = 0
///
/// Closed rigid rows of force laws go with the joints. Impacts are not its business: a state that
/// they change can be given to it. Friction of rigid contacts is decided row by row here, not for
/// all places together.
///
/// No sieve, no interface compliance, no condensation: it shares the physics (dynamics) and the
/// coefficients of the method (Scheme) with Stepper, and must arrive at the same state. Coupling
/// terms are iterated together with everything else. Cost per step: several factorisations of an
/// indefinite matrix of twice the number of unknowns.
class MonolithicStepper {
 public:
  /// @param rows_in_use independent joint rows
  MonolithicStepper(const model::Model& model, const stepping::StepSettings& settings,
                    std::vector<int> rows_in_use);
  ~MonolithicStepper();

  /// Advances `state` by one step, iterating until changes are at rounding or at
  /// `settings.newton_tolerance` relative to the motion of the step.
  /// @throws NumericalError if the iteration does not converge; `state` is then unchanged
  stepping::StepReport step(model::State& state);

  const stepping::Scheme& scheme() const { return scheme_; }

 private:
  struct Part;  // one body: its unknowns and its motion within the step
  /// Derivative with respect to a velocity-carrying unknown, and its place among the corrections.
  struct Entry {
    int column, correction_column;
    double value;
  };

  bool corrects_positions() const;
  dynamics::Circumstances around() const {
    return {&inputs_, &memory_, &lambda_, &rigid_.stands()};
  }
  void start(const model::State& state);
  void predict(double t);
  void evaluate(double t);
  void update_coupling(Part& part);
  std::vector<Entry> entries(const dynamics::SystemRow& row) const;
  void fixed_part();
  void fixed_body(const Part& part);
  void fixed_corrections();
  void fixed_rigid_corrections();
  void rigid_tangent(std::vector<linalg::Triplet>& out) const;
  void rigid_residual(linalg::Vector& r) const;
  /// Laws that have gone from one end of their set to the other are held for an iteration.
  void hold_reversed(double t);
  void held_residual(double t, linalg::Vector& r) const;
  /// Rigid rows go where their sets put them. @return whether any did
  bool move_rigid_rows();
  /// Forms the fixed part again if rigid rows have opened or closed since.
  void follow_regimes();
  void add_product(const std::vector<Entry>& row, const std::vector<Entry>& column, double factor,
                   bool row_corrects, bool column_corrects);
  void tangent(std::vector<linalg::Triplet>& out) const;
  linalg::Vector residual(double t) const;
  void body_residual(std::size_t b, linalg::Vector& r) const;
  double apply(const linalg::Vector& change, double& motion);
  void iterate(double t, stepping::StepReport& report);
  model::State next_state(const model::State& state) const;

  const model::Model& model_;
  stepping::StepSettings settings_;
  stepping::Scheme scheme_;
  std::vector<int> rows_in_use_;
  std::vector<char> rates_only_;  // of each row of λ
  std::vector<std::unique_ptr<Part>> parts_;
  int first_lambda_ = 0, first_correction_ = 0, size_ = 0;
  int first_rigid_ = 0, first_rigid_correction_ = 0;
  stepping::RigidRows rigid_;
  linalg::Vector z_;                    // all unknowns
  linalg::Vector lambda_;               // [N, N m]
  std::vector<linalg::Triplet> fixed_;  // what does not change within a step
  linalg::SparseMatrix fixed_matrix_;
  dynamics::SoftRows soft_;
  stepping::HeldLaws held_;
  std::vector<int> regimes_before_;  // of the iteration before
  // For the corrections of positions: as predicted, but rigid rows as they stand now.
  dynamics::SoftRows correcting_;
  std::vector<dynamics::SystemRow> predicted_rows_;
  dynamics::Constraints end_, evaluation_;
  std::vector<dynamics::BodyMotion> motions_end_, motions_evaluation_;
  dynamics::Forces forces_;
  model::LoadInputs inputs_;
  model::RowMemory memory_;  // at the start of the step
  OrderedLu lu_;
};

}  // namespace buckens::verification
