// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/factor_group.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

namespace {
// What kept solves may leave of the coupling load without an answer, relative to it: a tenth of
// what a second solve may (kSecondSolve), and with a finer tolerance less.
constexpr double kLeftBySolve = 1e-5;
constexpr double kLeftPerTolerance = 10.0;
// Combining answers reads 3 numbers of four bytes per variable and pair. It may cost this share of
// the two passes of a solve.
constexpr double kShareOfSolve = 0.5;
constexpr double kBytesPerPair = 12.0;
// With fewer pairs a space of vibrations is not spanned.
constexpr int kLeastPairs = 8;
// A solve with a factor of so few bytes, which stays in the cache, is a small part of a step.
constexpr double kLeastBytes = 100e3;

int most_pairs(const linalg::Factor& factor, const linalg::Vector& inverse_diagonal,
               const StepSettings& settings) {
  if (settings.iterate_coupling || inverse_diagonal.size() == 0) return 0;
  // What kept solves leave, 1e-5 of a change of load, is far above what an iteration leaves.
  if (factor.iterates()) return 0;
  const double pays =
      kShareOfSolve * 2.0 * factor.bytes() / (kBytesPerPair * static_cast<double>(factor.size()));
  if (pays < kLeastPairs || factor.bytes() < kLeastBytes) return 0;
  return static_cast<int>(std::min<double>(settings.kept_solves, pays));
}
}  // namespace

FactorGroup::FactorGroup(const linalg::Factor& factor, const linalg::Vector& inverse_diagonal,
                         const StepSettings& settings)
    : factor_(&factor),
      exchange_(settings.exchange),
      left_(std::min(kLeftBySolve, kLeftPerTolerance * settings.outer_tolerance)),
      kept_(inverse_diagonal, most_pairs(factor, inverse_diagonal, settings), factor.row_order()) {}

void FactorGroup::add(FlexibleStep& body, std::size_t index) {
  body.index = index;
  bodies_.push_back(&body);
  active_.reserve(bodies_.size());
  sides_.reserve(bodies_.size());
  requests_.reserve(bodies_.size());
}

void FactorGroup::iterate(const model::State& before) {
  for (FlexibleStep* body : active_) {
    ++body->solves;
    const linalg::IterationCounts earlier = factor_->iteration_counts();
    try {
      body->large.iterate(before.bodies[body->index], *factor_);
    } catch (const NumericalError& error) {
      throw StepFailure(fmt::format("step at t = {:.6g} s failed: body \"{}\": {}", before.t,
                                    body->name, error.what()));
    }
    const linalg::IterationCounts now = factor_->iteration_counts();
    body->iterations += now.iterations - earlier.iterations;
    body->solve_seconds += now.seconds - earlier.seconds;
  }
}

void FactorGroup::solve(const model::State& before, TaskPool* pool) {
  if (active_.empty()) return;
  if (factor_->iterates()) return iterate(before);
  sides_.clear();
  for (FlexibleStep* body : active_) {
    ++body->solves;
    if (body->large.is_divided()) {
      body->large.solve_divided(*factor_);
    } else {
      sides_.push_back(body->large.side().data());
    }
  }
  if (sides_.empty()) return;
  if (exchange_ != nullptr) {
    exchange_->solve(*factor_, sides_, pool);
  } else {
    factor_->solve_in_place(sides_, pool);
  }
}

void FactorGroup::solve_loads(const model::State& before, TaskPool* pool) {
  requests_.clear();
  active_.assign(bodies_.begin(), bodies_.end());
  if (factor_->iterates()) {
    for (FlexibleStep* body : active_) body->large.sieve_side();
  }
  solve(before, pool);
}

void FactorGroup::answer_changes(const model::State& before, bool recycles, TaskPool* pool) {
  active_.clear();
  for (FlexibleStep* body : bodies_) {
    if (!body->coupling.load_changed()) continue;
    if (factor_->iterates()) body->large.sieve_side();
    const double limit = left_ * body->large.op().scheme().force * body->coupling.load_size();
    if (recycles) requests_.push_back(&body->request);
    if (recycles && answer(*body, limit, pool)) {
      ++body->recycled;
    } else {
      active_.push_back(body);
    }
  }
  solve(before, pool);
  if (!recycles) return;
  for (FlexibleStep* body : active_) complete(*body, pool);
}

bool FactorGroup::answer(FlexibleStep& body, double limit, TaskPool* pool) {
  if (!body.large.is_divided()) return kept_.answer(body.large.side(), limit, body.request, pool);
  return kept_.answer(body.large.divided_side(), limit, body.request);
}

void FactorGroup::complete(FlexibleStep& body, TaskPool* pool) {
  if (!body.large.is_divided()) return kept_.complete(body.request, body.large.side(), pool);
  kept_.complete(body.request, body.large.divided_side());
}

void FactorGroup::learn(TaskPool* pool) {
  kept_.learn(requests_, pool);
  requests_.clear();
}

void FactorGroup::forget() {
  kept_.forget();
  requests_.clear();
}

}  // namespace buckens::stepping
