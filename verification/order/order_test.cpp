// SPDX-License-Identifier: Apache-2.0
// Order of convergence where every mode is resolved; see README.md.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/body/free_modes.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/results/state_interpolation.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::order {
namespace {

using linalg::Vector;
using stepping::Method;

constexpr double kDuration = 0.25;
constexpr Method kMethods[] = {Method::generalized_alpha, Method::newmark, Method::hht,
                               Method::wilson};

/// What is compared at t = kDuration.
struct Sample {
  Vector d, d_dot, frame, lambda;
};

Sample sample(const model::Model& model, const test::Start& start, Method method, double h) {
  const auto settings = test::settings(method, h);
  stepping::Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  const long steps = std::lround(kDuration / h);
  model::State before;
  for (long k = 0; k < steps; ++k) {
    before = state;
    stepper.step(state);
  }
  const model::BodyState& body = state.bodies[0];
  Sample out{body.d, body.d_dot, Vector(12), state.lambda};
  out.frame << body.frame.X_WB.p, 2.0 * body.frame.X_WB.q.vec(), body.frame.w, body.frame.v;
  if (method == Method::newmark) {
    // λ belongs to the middle of a step: the mean of two neighbours belongs to the step's end.
    stepper.step(state);
    out.lambda = 0.5 * (out.lambda + state.lambda);
  } else if (method == Method::wilson) {
    // λ belongs to t + θh of each step, 0.4 h behind the end of this one.
    out.lambda = results::multipliers_at(before, state, state.t);
  }
  return out;
}

double order(const Vector& a, const Vector& b, const Vector& c) {
  return test::observed_order((a - b).norm(), (b - c).norm());
}

void expect_order_two(const model::Model& model, const test::Start& start, Method method) {
  SCOPED_TRACE(stepping::to_string(method));
  const body::FlexiblePart& part = *model.bodies[0].flexible;
  const auto modes = body::free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), 100);
  EXPECT_LT(modes.omega.maxCoeff() * 1e-4, 0.1) << "the steps must resolve every mode";
  std::vector<Sample> at;
  for (const double h : {1e-4, 5e-5, 2.5e-5}) at.push_back(sample(model, start, method, h));
  // (ω h)² ≤ 1 % is the size of the terms of fourth order.
  EXPECT_NEAR(order(at[0].d, at[1].d, at[2].d), 2.0, 0.1);
  EXPECT_NEAR(order(at[0].d_dot, at[1].d_dot, at[2].d_dot), 2.0, 0.1);
  EXPECT_NEAR(order(at[0].frame, at[1].frame, at[2].frame), 2.0, 0.1);
  EXPECT_NEAR(order(at[0].lambda, at[1].lambda, at[2].lambda), 2.0, 0.1);
}

TEST(Order, SoftPlanarPendulum) {
  test::BeamConstants beam;
  beam.EA = 200;
  beam.EIz = 2;
  beam.elements = 2;
  const model::Model model = test::planar_beam_pendulum(beam);
  const test::Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    expect_order_two(model, start, method);
  }
}

TEST(Order, SoftDampedPendulumInSpace) {
  test::BeamConstants beam;
  beam.EA = 200;
  beam.EIy = 1.5;
  beam.EIz = 2;
  beam.alpha = 0.3;
  beam.beta = 1e-4;
  beam.elements = 2;
  const model::Model model = test::spatial_beam_pendulum(beam);
  const test::Start start = test::consistent_start(model, [](model::State& state) {
    body::FrameMotion& frame = state.bodies[0].frame;
    frame.w << 2, -1, 3;
    frame.v = frame.w.cross(frame.X_WB.p);
  });
  for (const Method method : kMethods) {
    expect_order_two(model, start, method);
  }
}

TEST(Wilson, IsStableOnTheFlexiblePendulum) {
  // Joints close the velocities at the end of a step while forces act at t + 1.4 h. Axial
  // vibrations with ωh > 3 are not resolved; 5 s are about two periods.
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  const test::Start start = test::consistent_start(model);
  stepping::Stepper stepper(model, test::settings(Method::wilson, 1e-3), start.rows_in_use);
  model::State state = start.state;
  Vector before = state.lambda;
  Vector now = state.lambda;
  double early = 0, late = 0;  // largest second difference of λ: shows a ripple
  for (int k = 0; k < 5000; ++k) {
    stepper.step(state);
    const double ripple = (state.lambda - 2 * now + before).norm();
    before = now;
    now = state.lambda;
    (k < 1000 ? early : late) = std::max(k < 1000 ? early : late, ripple);
  }
  EXPECT_LE(late, early);
  // Rigid parts of the nodal variables stay at rounding.
  const model::BodyState& beam = state.bodies[0];
  EXPECT_LE(model.bodies[0].flexible->sieve.rigid_part(beam.d_dot).norm(), 1e-12);
}

}  // namespace
}  // namespace buckens::verification::order
