// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/recycled_solves.h"
#include "buckens/linalg/solve_exchange.h"
#include "buckens/stepping/flexible_step.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// Bodies whose solves read the same factor, so that they go together as right-hand sides.
///
/// The second large solve of a step is for the change of the coupling load. These changes repeat
/// themselves, so answers to them are kept and combined, for all bodies of the group
/// (docs/theory/08-coupling.md).
class FactorGroup {
 public:
  /// @param inverse_diagonal of K̂; empty: no changes of load are to be answered
  FactorGroup(const linalg::Factor& factor, const linalg::Vector& inverse_diagonal,
              const StepSettings& settings);

  const linalg::Factor& factor() const { return *factor_; }
  /// @param index of the body in the model
  void add(FlexibleStep& body, std::size_t index);

  /// Solves for the right-hand sides of all bodies.
  /// @param before start of the step
  /// @throws StepFailure naming the body if an iteration does not converge
  void solve_loads(const model::State& before, TaskPool* pool);
  /// The same for those whose coupling load has changed.
  /// @param recycles whether earlier solves may answer, and later ones learn
  void answer_changes(const model::State& before, bool recycles, TaskPool* pool);
  /// Keeps what answer_changes() found in the last step.
  void learn(TaskPool* pool);
  void forget();

  void visit_saved(const base::SaveVisit& visit) { kept_.visit_saved(visit); }

 private:
  void solve(const model::State& before, TaskPool* pool);
  void iterate(const model::State& before);
  bool answer(FlexibleStep& body, double limit, TaskPool* pool);
  void complete(FlexibleStep& body, TaskPool* pool);

  const linalg::Factor* factor_;
  linalg::SolveExchange* exchange_;
  double left_;  // of a coupling load by a change that is answered, relative
  std::vector<FlexibleStep*> bodies_;
  std::vector<FlexibleStep*> active_;  // those that solve in this round
  std::vector<double*> sides_;
  std::vector<linalg::RecycledSolves::Request*> requests_;  // of this step
  linalg::RecycledSolves kept_;
};

}  // namespace buckens::stepping
