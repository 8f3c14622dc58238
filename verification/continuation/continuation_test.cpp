// SPDX-License-Identifier: Apache-2.0
// A copy of the state is all that a run needs to go on; see README.md.
#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification {
namespace {

/// Runs on from a copy with a new stepper and compares with the run that was never interrupted.
void expect_same_bits(const model::Model& model, stepping::Method method, double h) {
  const test::Start start = test::consistent_start(model);
  stepping::StepSettings settings;
  settings.method = method;
  settings.step = h;
  stepping::Stepper through(model, settings, start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 60; ++k) through.step(state);

  model::State copy = state;
  stepping::Stepper resumed(model, settings, start.rows_in_use);
  for (int k = 0; k < 60; ++k) {
    through.step(state);
    resumed.step(copy);
  }
  EXPECT_EQ(state.t, copy.t);
  EXPECT_TRUE((state.lambda.array() == copy.lambda.array()).all());
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const model::BodyState& x = state.bodies[b];
    const model::BodyState& y = copy.bodies[b];
    EXPECT_EQ(x.frame.X_WB.p, y.frame.X_WB.p);
    EXPECT_EQ(x.frame.X_WB.q.coeffs(), y.frame.X_WB.q.coeffs());
    EXPECT_EQ(x.frame.w, y.frame.w);
    EXPECT_EQ(x.w_alg, y.w_alg);
    EXPECT_TRUE((x.d.array() == y.d.array()).all());
    EXPECT_TRUE((x.d_dot.array() == y.d_dot.array()).all());
    EXPECT_TRUE((x.d_alg.array() == y.d_alg.array()).all());
  }
}

TEST(Continuation, RigidDoublePendulum) {
  expect_same_bits(test::rigid_double_pendulum(false), stepping::Method::generalized_alpha, 1e-3);
}

TEST(Continuation, SliderCrankGeneralizedAlpha) {
  expect_same_bits(test::slider_crank(4), stepping::Method::generalized_alpha, 5e-5);
}

TEST(Continuation, SliderCrankNewmark) {
  expect_same_bits(test::slider_crank(4), stepping::Method::newmark, 5e-5);
}

TEST(Continuation, SpatialBeamPendulum) {
  expect_same_bits(test::spatial_beam_pendulum({}), stepping::Method::generalized_alpha, 1e-4);
}

}  // namespace
}  // namespace buckens::verification
