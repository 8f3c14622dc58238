// SPDX-License-Identifier: Apache-2.0
// Guesses of multipliers and accelerations from three steps.
#include "buckens/stepping/forecast.h"

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/stepper.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::stepping {
namespace {

constexpr double kStep = 1e-3;

std::vector<int> every_row(const model::Model& model) {
  std::vector<int> out(static_cast<std::size_t>(model.num_constraint_rows()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

using Course = Vector6 (*)(double t);

Vector6 cubic_free(double t) {
  Vector6 out;
  out << 1 + 2 * t, 3 * t * t, -1, 0.5 - t + 40 * t * t, 7, t;
  return out;
}

Vector6 alternating(double t) { return std::cos(M_PI * t / kStep) * Vector6::Ones(); }

/// A state of two bodies that three steps have led to; λ goes like the second body.
model::State led_to(const std::array<double, 3>& times, Course course) {
  model::State state;
  state.history = 3;
  state.t = state.lambda_time = times[2];
  state.bodies.resize(2);
  for (int b = 0; b < 2; ++b) {
    const Vector6 now = (b + 1) * course(times[2]);
    state.bodies[static_cast<std::size_t>(b)].w_dot = now.head<3>();
    state.bodies[static_cast<std::size_t>(b)].v_dot = now.tail<3>();
  }
  state.lambda = 2 * course(times[2]);
  const auto fill = [&](double t, model::PastStep& past) {
    past.t = t;
    past.lambda = 2 * course(t);
    past.accelerations.resize(12);
    past.accelerations << course(t), 2 * course(t);
  };
  fill(times[1], state.before);
  fill(times[0], state.earlier);
  return state;
}

TEST(Forecast, ForetellsParabolasThroughStepsOfAnyLength) {
  const model::State state = led_to({0.0, 0.6 * kStep, 2.0 * kStep}, cubic_free);
  for (const Method method : {Method::generalized_alpha, Method::newmark, Method::hht}) {
    const Scheme scheme(method, kStep, method == Method::hht ? -0.1 : 0.9);
    const Forecast forecast(scheme, 1.0);
    ASSERT_TRUE(forecast.foretells(state));
    std::vector<BodyStep> bodies(2);
    for (std::size_t b = 0; b < 2; ++b) bodies[b].start(state.bodies[b], nullptr, scheme);
    linalg::Vector lambda;
    forecast.apply(state, bodies, lambda);
    const Vector6 expected = cubic_free(scheme.evaluation_time(state.t));
    // Rounding of weights up to five, and of increments, which are h² of accelerations.
    const double rounding = 1e-13 * expected.norm();
    EXPECT_LE((bodies[0].frame_acceleration(scheme) - expected).norm(), rounding);
    EXPECT_LE((bodies[1].frame_acceleration(scheme) - 2 * expected).norm(), 2 * rounding);
    EXPECT_LE((lambda - 2 * expected).norm(), 2 * rounding);
  }
}

TEST(Forecast, KeepsSilentWhereItDoesNotKnow) {
  const Forecast forecast(Scheme(Method::generalized_alpha, kStep, 0.9), 1.0);
  const std::array<double, 3> steps = {0.0, kStep, 2 * kStep};
  const model::State smooth = led_to(steps, cubic_free);
  EXPECT_TRUE(forecast.foretells(smooth));
  // A vibration that steps do not resolve.
  EXPECT_FALSE(forecast.foretells(led_to(steps, alternating)));
  model::State after_jump = smooth;
  after_jump.history = 2;
  EXPECT_FALSE(forecast.foretells(after_jump));
  model::State without_past = smooth;
  without_past.earlier = {};
  EXPECT_FALSE(forecast.foretells(without_past));
  // Steps a tenth as long as the one ahead.
  EXPECT_FALSE(forecast.foretells(led_to({0.0, 0.1 * kStep, 0.2 * kStep}, cubic_free)));
  EXPECT_FALSE(Forecast(Scheme(Method::wilson, kStep, 1.4), 1.0).foretells(smooth));
}

TEST(Forecast, SavesIterationsAndChangesNothingElse) {
  const model::Model model = test::rigid_double_pendulum(false);
  StepSettings settings;
  settings.step = 5e-4;
  Stepper with(model, settings, every_row(model));
  Stepper without(model, settings, every_row(model));
  model::State foreseen = model::placed_state(model);
  model::State plain = model::placed_state(model);
  int iterations_with = 0;
  int iterations_without = 0;
  constexpr int kSteps = 200;
  for (int k = 0; k < kSteps; ++k) {
    iterations_with += with.step(foreseen).newton_iterations;
    plain.before = plain.earlier = {};  // leaves nothing to tell from
    iterations_without += without.step(plain).newton_iterations;
  }
  EXPECT_LE(iterations_with, 1.5 * kSteps);
  EXPECT_GT(iterations_without, 1.5 * kSteps);
  // Every step leaves up to 1e-15 of the length, 2 m, open in a motion of 5e-4 s; so rates may
  // differ by 4e-12 per step where these errors go one way, positions by that over 0.1 s. The fall
  // of a double pendulum amplifies them by less than five in this time.
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::FrameMotion& x = foreseen.bodies[b].frame;
    const body::FrameMotion& y = plain.bodies[b].frame;
    EXPECT_LE((x.X_WB.p - y.X_WB.p).norm(), kSteps * 2e-11 * 0.1);
    EXPECT_LE((x.v - y.v).norm(), kSteps * 2e-11);
    EXPECT_LE((x.w - y.w).norm(), kSteps * 2e-11);
  }
}

TEST(Forecast, DependsOnTheStateAlone) {
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  StepSettings settings;
  settings.kept_solves = 0;
  Stepper stepper(model, settings, every_row(model));
  model::State state = model::placed_state(model);
  for (int k = 0; k < 10; ++k) stepper.step(state);
  model::State once = state;
  stepper.step(once);
  stepper.step(once);
  model::State again = state;  // as after a rejected step
  stepper.step(again);
  Stepper other(model, settings, every_row(model));
  other.step(again);
  test::expect_same(once, again);
}

}  // namespace
}  // namespace buckens::stepping
