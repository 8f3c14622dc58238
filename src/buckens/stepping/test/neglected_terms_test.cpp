// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/neglected_terms.h"

#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/stepper.h"

namespace buckens::stepping {
namespace {

using body::CouplingTerms;

TEST(NeglectedShare, OfAnUndeformedBodyThatAcceleratesOnly) {
  // ẇ alone on an undeformed straight beam: nothing depends on the deformation, ĉ is zero.
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  const body::Body& body = model.bodies[0];
  const BodyStepOperator op(*body.flexible, Scheme(Method::generalized_alpha, 1e-3, 0.9));
  model::BodyState state = model::placed_state(model).bodies[0];
  state.w_dot << 0, 0, 2;
  EXPECT_EQ(neglected_share(body, op, state, CouplingTerms::none()), 0.0);
  // A spin stretches it: at `none` nothing acts on the mesh, and ĉ is as large as the other
  // inertia.
  state.frame.w << 0, 0, 3;
  EXPECT_GT(neglected_share(body, op, state, CouplingTerms::none()), 0.2);
  EXPECT_EQ(neglected_share(body, op, state, CouplingTerms::first_order()), 0.0);
  EXPECT_EQ(neglected_share(body, op, state, {}), 0.0);
}

TEST(NeglectedShare, GrowsWithTheSquareOfTheSpin) {
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  const body::Body& body = model.bodies[0];
  const BodyStepOperator op(*body.flexible, Scheme(Method::generalized_alpha, 1e-3, 0.9));
  model::BodyState state = model::placed_state(model).bodies[0];
  const body::FreeModes modes =
      body::free_modes(body.flexible->fe.M, body.flexible->fe.K, body.flexible->sieve.Phi(), 1);
  state.d = 0.01 * modes.shapes.col(0);  // bending: H d is zero in the directions that remain
  const auto share = [&](double w) {
    state.frame.w << 0, 0, w;
    return neglected_share(body, op, state, CouplingTerms::first_order());
  };
  // Against K d, which does not change, and the load that balances it.
  EXPECT_NEAR(share(0.2) / share(0.1), 4.0, 1e-2);
}

TEST(NeglectedShare, FollowsFromTheBalanceOfAStepWithoutStiffness) {
  test::BeamConstants beam;
  beam.alpha = 0.5;
  beam.beta = 1e-4;
  const model::Model model = test::planar_beam_pendulum(beam, body::CouplingLevel::none);
  StepSettings settings;
  settings.step = 1e-4;
  settings.newton_tolerance = 1e-13;
  Stepper stepper(model, settings, {0, 1});
  model::State state = model::placed_state(model);
  for (int k = 0; k < 100; ++k) stepper.step(state);
  const auto terms = CouplingTerms::none();
  const BodyStepOperator op(*model.bodies[0].flexible, stepper.scheme());
  const double by_products = neglected_share(model.bodies[0], op, state.bodies[0], terms);
  EXPECT_GT(by_products, 0.0);
  // Accelerations are positions over h²: rounding of 1e-16 m stands for 1e-8 m/s².
  EXPECT_NEAR(stepper.neglected(0, state, terms), by_products, 1e-6 * by_products);
}

}  // namespace
}  // namespace buckens::stepping
