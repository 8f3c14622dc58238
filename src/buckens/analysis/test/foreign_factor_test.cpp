// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/stepping/step_failure.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::analysis {
namespace {

/// A factor supplied from outside, which SparseCholesky stands behind.
class ForeignFactor : public linalg::Factor {
 public:
  explicit ForeignFactor(const linalg::SparseMatrix& A) : factor_(A) {}

  Eigen::Index size() const override { return factor_.size(); }
  double num_factor_entries() const override { return factor_.num_factor_entries(); }
  double bytes() const override { return factor_.bytes(); }
  using Factor::solve;
  using Factor::solve_in_place;
  void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const override {
    factor_.solve(B, X, columns, pool);
  }
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool) const override {
    factor_.solve_in_place(vectors, pool);
  }

 private:
  linalg::SparseCholesky factor_;
};

/// Counts the columns solved for.
class CountedFactor final : public ForeignFactor {
 public:
  CountedFactor(const linalg::SparseMatrix& A, long& columns)
      : ForeignFactor(A), columns_(columns) {}

  using Factor::solve;
  using Factor::solve_in_place;
  void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const override {
    columns_ += columns;
    ForeignFactor::solve(B, X, columns, pool);
  }
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool) const override {
    columns_ += static_cast<long>(vectors.size());
    ForeignFactor::solve_in_place(vectors, pool);
  }

 private:
  long& columns_;
};

/// A solver that iterates, as the step sees it: exact, but it looks at the estimates.
class EstimatedFactor final : public ForeignFactor {
 public:
  EstimatedFactor(const linalg::SparseMatrix& A, double& largest_error, long& changes)
      : ForeignFactor(A), A_(A), largest_error_(largest_error), changes_(changes) {}

  bool iterates() const override { return true; }
  void improve(const linalg::Vector& b, linalg::Vector& x, double energy) const override {
    const linalg::Vector estimate = x;
    x = b;
    Factor::solve_in_place(x);
    if (energy > 0.0) {  // of the motion, for a change of it
      EXPECT_LE(std::sqrt(b.dot(x)), energy);
      ++changes_;
      return;
    }
    const linalg::Vector error = estimate - x;
    const double share = std::sqrt(error.dot(A_ * error) / b.dot(x));
    if (++calls_ > kFirst) largest_error_ = std::max(largest_error_, share);
  }

  static constexpr int kFirst = 20;

 private:
  linalg::SparseMatrix A_;
  double& largest_error_;
  long& changes_;
  mutable int calls_ = 0;
};

TEST(StepSettings, ASolverThatIteratesGetsGoodEstimates) {
  const model::Model model = test::slider_crank(12);
  const test::Start start = test::consistent_start(model);
  for (const auto method : {stepping::Method::generalized_alpha, stepping::Method::newmark,
                            stepping::Method::hht, stepping::Method::wilson}) {
    stepping::StepSettings settings = test::settings(method, 1e-6);
    settings.iterate_coupling = false;
    const model::State expected = test::simulate(model, start, settings, 1e-4);
    double largest_error = 0.0;
    long changes = 0;
    settings.make_factor = [&](const linalg::MatrixSum& A) {
      return std::make_shared<const EstimatedFactor>(A.whole(), largest_error, changes);
    };
    const model::State found = test::simulate(model, start, settings, 1e-4);
    const linalg::Vector& d = expected.bodies[1].d;
    // Both solve exactly; what is sieved before or after differs by rounding, of joints as well.
    EXPECT_LE((found.bodies[1].d.whole() - d).norm(), 1e-9 * d.norm())
        << stepping::to_string(method);
    // The fastest vibration of an element, along the rod, has ω = √12 c/l = 7e5 rad/s: what the
    // extrapolation lacks of any vibration is at most (h ω)³/6.
    EXPECT_LE(largest_error, 0.06) << stepping::to_string(method);
    EXPECT_GT(largest_error, 0.0);
  }
}

TEST(StepSettings, AnIterationThatFailsNamesTheBody) {
  class Failing final : public linalg::Factor {
   public:
    explicit Failing(const linalg::SparseMatrix& A) : factor_(A) {}
    Eigen::Index size() const override { return factor_.size(); }
    double num_factor_entries() const override { return factor_.num_factor_entries(); }
    double bytes() const override { return factor_.bytes(); }
    void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const override {
      factor_.solve(B, X, columns, pool);
    }
    void solve_in_place(std::span<double* const> vectors, TaskPool* pool) const override {
      factor_.solve_in_place(vectors, pool);
    }
    bool iterates() const override { return true; }
    void improve(const linalg::Vector&, linalg::Vector&, double) const override {
      throw NumericalError("no convergence in 500 iterations");
    }

   private:
    linalg::SparseCholesky factor_;
  };
  const model::Model model = test::slider_crank(12);
  const test::Start start = test::consistent_start(model);
  stepping::StepSettings settings = test::settings(stepping::Method::generalized_alpha, 1e-4);
  settings.make_factor = [](const linalg::MatrixSum& A) {
    return std::make_shared<const Failing>(A.whole());
  };
  stepping::Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  try {
    stepper.step(state);
    FAIL();
  } catch (const stepping::StepFailure& failure) {
    const std::string text = failure.what();
    EXPECT_NE(text.find("step at t = 0 s failed: body \"" + model.bodies[1].name + "\""),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("no convergence in 500 iterations"), std::string::npos) << text;
  }
  test::expect_same(state, start.state);
}

TEST(StepSettings, AnotherFactorMaySolveForAllBodies) {
  const model::Model model = test::slider_crank(12);
  const test::Start start = test::consistent_start(model);
  stepping::StepSettings settings = test::settings(stepping::Method::generalized_alpha, 1e-4);
  const model::State expected = test::simulate(model, start, settings, 2e-3);

  long factors = 0, columns = 0;
  settings.make_factor = [&](const linalg::MatrixSum& A) {
    ++factors;
    return std::make_shared<const CountedFactor>(A.whole(), columns);
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
