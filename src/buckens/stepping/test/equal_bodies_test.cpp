// SPDX-License-Identifier: Apache-2.0
// Small bodies with equal matrices, as the parts of a divided beam are.
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/stepping/test/row_of_rods.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::stepping {
namespace {

using Eigen::Vector3d;

std::vector<int> all_rows(const model::Model& model) {
  std::vector<int> out(static_cast<std::size_t>(model.num_constraint_rows()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

long setup_solves(const Stepper& stepper, std::size_t bodies) {
  long sum = 0;
  for (std::size_t b = 0; b < bodies; ++b) sum += stepper.counts(b).setup_solves;
  return sum;
}

TEST(EqualBodies, HaveOneOperator) {
  const model::Model equal = test::row_of_rods(4, spatial::Plane::xy);
  const model::Model different = test::row_of_rods(4, spatial::Plane::xy, 2.0);
  const Scheme scheme(Method::generalized_alpha, 1e-4, 0.9);
  const BodyStepOperator op(*equal.bodies[1].flexible, scheme);
  EXPECT_TRUE(op.serves(*equal.bodies[2].flexible));
  EXPECT_FALSE(op.serves(*different.bodies[3].flexible));
  // The same matrices, but nothing is fixed to its end.
  EXPECT_TRUE(op.fits(*equal.bodies[3].flexible));
  EXPECT_FALSE(op.serves(*equal.bodies[3].flexible));

  StepSettings settings;
  settings.step = 1e-4;
  const Stepper stepper(equal, settings, all_rows(equal));
  EXPECT_EQ(stepper.counts(0).factorisations, 1);
  for (std::size_t b : {1, 2, 3}) EXPECT_EQ(stepper.counts(b).factorisations, 0);
  EXPECT_GT(stepper.counts(0).setup_solves, 0);
  EXPECT_EQ(stepper.counts(1).setup_solves, 0);
  EXPECT_EQ(stepper.counts(2).setup_solves, 0);
  EXPECT_EQ(setup_solves(stepper, 4),
            stepper.counts(0).setup_solves + stepper.counts(3).setup_solves);
}

TEST(EqualBodies, SolveOnceWhereTheirCouplingMovesNothing) {
  const model::Model model = test::row_of_rods(8, spatial::Plane::xy);
  StepSettings settings;
  settings.step = 1e-4;
  constexpr int kSteps = 100;
  Stepper once(model, settings, all_rows(model));
  settings.iterate_coupling = true;
  Stepper often(model, settings, all_rows(model));
  model::State a = model::placed_state(model);
  model::State b = a;
  for (int k = 0; k < kSteps; ++k) {
    once.step(a);
    often.step(b);
  }
  long solves_once = 0;
  long solves_often = 0;
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    solves_once += once.counts(k).solves;
    solves_often += often.counts(k).solves;
  }
  EXPECT_EQ(solves_once, kSteps * static_cast<long>(model.bodies.size()));
  EXPECT_GE(solves_often, solves_once);
  // What is left out moves a rod by 1e-19 of 1 cm in a step. Beside that the iteration leaves 1e-15
  // of the length, 8 cm, open in every step; over 0.01 s these add up to at most 1e-12 of it.
  const Vector3d tip_a = test::node_position(model, a, 7, 1);
  const Vector3d tip_b = test::node_position(model, b, 7, 1);
  EXPECT_GT((tip_a - Vector3d(0.08, 0, 0)).norm(), 1e-4);
  EXPECT_LE((tip_a - tip_b).norm(), 1e-12 * 0.08 * kSteps);
}

}  // namespace
}  // namespace buckens::stepping
