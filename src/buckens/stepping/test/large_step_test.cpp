// SPDX-License-Identifier: Apache-2.0
// Accuracy and reproducibility of passes over the vectors of a mesh.
#include "buckens/stepping/large_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "buckens/body/free_modes.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::stepping {
namespace {

using linalg::Vector;

std::unique_ptr<const body::FlexiblePart> steel_block(const std::array<int, 3>& divisions) {
  fem::Structure structure;
  fem::Box box;
  box.size = {1.0, 0.1, 0.1};
  box.divisions = divisions;
  fem::Material steel = fem::Material::isotropic(2.1e11, 0.3, 7850);
  steel.damping_mass = 0.1;
  steel.damping_stiffness = 1e-7;
  fem::add_box(structure, box, steel);
  auto part = std::make_unique<body::FlexiblePart>("block", fem::assemble(structure),
                                                   body::CouplingLevel::full);
  part->rows.resize(0, part->num_dofs());
  return part;
}

/// The state that `count` steps without loads lead to.
model::BodyState after_steps(BodyStepOperator& op, model::BodyState state, int count,
                             TaskPool* pool) {
  LargeStep step(op);
  const Vector nothing = Vector::Zero(op.num_rows());
  Vector y_free;
  model::BodyState next;
  for (int k = 0; k < count; ++k) {
    step.form_right_side(state, {}, pool);
    op.solve_right_side(step.side(), pool);
    step.take_solution(state, y_free, pool);
    step.complete(state, nothing, nothing, next, pool);
    EXPECT_TRUE(step.is_finite());
    std::swap(state, next);
  }
  return state;
}

TEST(LargeStep, AccelerationsKeepTheDigitsThatTheStepAllows) {
  const auto block = steel_block({12, 2, 2});
  const body::FlexiblePart& part = *block;
  const body::FreeModes modes = body::free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), 1);
  const Vector shape = modes.shapes.col(0);
  const double omega = modes.omega[0];
  double last = 0;
  for (const double h_omega : {1e-2, 1e-3, 1e-4}) {
    BodyStepOperator op(part, Scheme(Method::generalized_alpha, h_omega / omega, 1.0));
    model::BodyState start;
    start.d = shape;
    start.d_dot = Vector::Zero(shape.size());
    start.d_ddot = -omega * omega * shape;
    start.d_alg = start.d_ddot;
    const model::BodyState end = after_steps(op, start, 10, nullptr);
    // Damping of 1e-4 of the critical one and the step itself change the shape's share only; what
    // is left beside it is rounding.
    const double share = shape.dot(part.fe.M * end.d_ddot.whole());
    const Vector rest = end.d_ddot.whole() - share * shape;
    const double noise = std::sqrt(rest.dot(part.fe.M * rest)) / (omega * omega);
    // Positions are rounded to some units in the last place, accelerations to that over (h ω)².
    EXPECT_LE(noise, 1e3 * 2.2e-16 / (h_omega * h_omega)) << h_omega;
    RecordProperty("noise_" + std::to_string(h_omega), std::to_string(noise * 1e12));
    last = std::max(last, noise);
  }
  EXPECT_GT(last, 0.0);
}

TEST(LargeStep, IsTheSameToTheLastBitWithAnyNumberOfThreads) {
  const auto block = steel_block({30, 6, 6});
  const body::FlexiblePart& part = *block;
  BodyStepOperator op(part, Scheme(Method::generalized_alpha, 1e-4, 0.9));
  model::BodyState start;
  const Eigen::Index n = part.num_dofs();
  ASSERT_GT(linalg::RowParts(n).count(), 1);
  for (linalg::NodalVector* v : {&start.d, &start.d_dot, &start.d_ddot, &start.d_alg}) {
    Vector& numbers = v->overwrite(n);
    for (Eigen::Index k = 0; k < n; ++k) numbers[k] = std::sin(static_cast<double>(k));
    part.sieve.apply(numbers);
  }
  const model::BodyState alone = after_steps(op, start, 3, nullptr);
  for (const int threads : {2, 3}) {
    TaskPool pool(threads);
    const model::BodyState shared = after_steps(op, start, 3, &pool);
    EXPECT_EQ(shared.d.whole(), alone.d.whole());
    EXPECT_EQ(shared.d_dot.whole(), alone.d_dot.whole());
    EXPECT_EQ(shared.d_ddot.whole(), alone.d_ddot.whole());
    EXPECT_EQ(shared.d_alg.whole(), alone.d_alg.whole());
  }
}

TEST(LargeStep, KnowsValuesOfPatternsOfASolidAfterAnySolve) {
  const auto block = steel_block({30, 6, 6});
  const Eigen::Index n = block->num_dofs();
  const auto some = [n](double frequency) -> Vector {
    return Vector::LinSpaced(n, 0.0, frequency * static_cast<double>(n)).array().sin();
  };
  for (const Method method : {Method::generalized_alpha, Method::newmark, Method::wilson}) {
    BodyStepOperator op(*block, Scheme(method, 1e-4, method == Method::wilson ? 1.4 : 0.9));
    ASSERT_NE(op.nodal(), nullptr);
    model::BodyState before, after;
    before.d = 1e-3 * some(1.0);
    before.d_dot = 0.1 * some(0.7);
    before.d_ddot = 10.0 * some(0.3);
    before.d_alg = 10.0 * some(0.4);
    for (linalg::NodalVector* v : {&before.d, &before.d_dot, &before.d_ddot, &before.d_alg}) {
      block->sieve.apply(v->change());
    }
    LargeStep step(op);
    const Vector first = 5e3 * some(0.2), second = 4e3 * some(0.5);
    const Vector nothing = Vector::Zero(op.num_rows());
    Vector y;
    step.form_right_side(before, first, nullptr);
    for (int solve = 0; solve < 2; ++solve) {
      if (solve > 0) step.form_right_side_of_change(first, second, nullptr);
      op.solve_right_side(step.side());
      step.take_solution(before, y, nullptr);
      step.complete(before, nothing, nothing, after, nullptr);
      const Vector expected = op.row_values(after.d.whole());
      // Sums of n products each, of which rigid motion is taken out afterwards.
      EXPECT_LE((y - expected).norm(), 1e-11 * expected.norm())
          << static_cast<int>(method) << solve;
    }
  }
}

TEST(LargeStep, TellsNumbersThatAreNone) {
  const auto block = steel_block({2, 1, 1});
  const body::FlexiblePart& part = *block;
  BodyStepOperator op(part, Scheme(Method::generalized_alpha, 1e-4, 0.9));
  LargeStep step(op);
  model::BodyState before, after;
  for (linalg::NodalVector* v : {&before.d, &before.d_dot, &before.d_ddot, &before.d_alg}) {
    v->overwrite(part.num_dofs()).setZero();
  }
  before.d_dot.change()[5] = HUGE_VAL;
  Vector y_free;
  step.form_right_side(before, {}, nullptr);
  op.solve_right_side(step.side());
  step.take_solution(before, y_free, nullptr);
  const Vector nothing = Vector::Zero(op.num_rows());
  step.complete(before, nothing, nothing, after, nullptr);
  EXPECT_FALSE(step.is_finite());
}

}  // namespace
}  // namespace buckens::stepping
