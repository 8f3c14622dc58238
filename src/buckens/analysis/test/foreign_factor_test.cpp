// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::analysis {
namespace {

/// A factor supplied from outside: SparseCholesky with a counter.
class CountedFactor final : public linalg::Factor {
 public:
  CountedFactor(const linalg::SparseMatrix& A, long& columns) : factor_(A), columns_(columns) {}

  Eigen::Index size() const override { return factor_.size(); }
  double num_factor_entries() const override { return factor_.num_factor_entries(); }
  double bytes() const override { return factor_.bytes(); }
  using Factor::solve;
  using Factor::solve_in_place;
  void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const override {
    columns_ += columns;
    factor_.solve(B, X, columns, pool);
  }
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool) const override {
    columns_ += static_cast<long>(vectors.size());
    factor_.solve_in_place(vectors, pool);
  }

 private:
  linalg::SparseCholesky factor_;
  long& columns_;
};

TEST(StepSettings, AnotherFactorMaySolveForAllBodies) {
  const model::Model model = test::slider_crank(12);
  const test::Start start = test::consistent_start(model);
  stepping::StepSettings settings = test::settings(stepping::Method::generalized_alpha, 1e-4);
  const model::State expected = test::simulate(model, start, settings, 2e-3);

  long factors = 0, columns = 0;
  settings.make_factor = [&](const linalg::SparseMatrix& A) {
    ++factors;
    return std::make_shared<const CountedFactor>(A, columns);
  };
  stepping::Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 20; ++k) stepper.step(state);

  test::expect_same(state, expected);
  long counted = 0, factorisations = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    counted += stepper.counts(b).solves + stepper.counts(b).setup_solves;
    factorisations += stepper.counts(b).factorisations;
  }
  EXPECT_EQ(factors, factorisations);
  EXPECT_EQ(columns, counted);
}

}  // namespace
}  // namespace buckens::analysis
