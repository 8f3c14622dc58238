// SPDX-License-Identifier: Apache-2.0
// The march along the ladder of steps: rejected steps leave no trace, the error follows the
// tolerance, and steps of changing length keep the order; see README.md.
#include <array>
#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verification/step_control/walk.h"

#include "buckens/base/errors.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/loads/applied_load.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"
#include "buckens/stepping/time_march.h"

namespace buckens::verification::step_control {
namespace {

using namespace stepping;
using linalg::Vector;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

MarchSettings fixed(double duration, long steps) { return {duration, 0, steps, std::nullopt}; }

test::BeamConstants soft_beam() {
  test::BeamConstants beam;
  beam.EA = 2e4;
  beam.EIz = 20;
  beam.elements = 2;
  return beam;
}

TEST(TimeMarch, WithoutToleranceItIsThePlainStepper) {
  const model::Model model = test::planar_beam_pendulum(soft_beam());
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  TimeMarch march(model, settings, start.rows_in_use, fixed(0.1, 64));
  settings.step = 0.1 / 64;
  Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  long step = 0;
  const model::State end = walk(march, start, [&](const auto&, const model::State& after) {
    stepper.step(state);
    // Counted, not summed.
    state.t = ++step == 64 ? 0.1 : static_cast<double>(step) * (0.1 / 64);
    EXPECT_EQ(after.t, state.t);
  });
  test::expect_same(end, state);
  EXPECT_EQ(march.report().accepted, 64);
  EXPECT_EQ(march.report().rejected + march.report().failed, 0);
  ASSERT_EQ(march.rungs().size(), 1U);
  EXPECT_EQ(march.rungs()[0].factorisations, 1);
}

TEST(TimeMarch, RejectedStepsLeaveNoTrace) {
  const model::Model model = test::planar_beam_pendulum(soft_beam());
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  TimeMarch march(model, settings, start.rows_in_use, controlled(0.5, 1e-3));
  // The accepted steps once more, without those that were rejected between them.
  settings.step = march.longest_step();
  StepLadder ladder(model, settings, start.rows_in_use);
  model::State replay = start.state;
  const model::State end =
      walk(march, start, [&](const model::State& before, const model::State& after) {
        const double h = after.last_step;
        ladder.rung(static_cast<int>(std::lround(std::log2(settings.step / h)))).step(replay);
        replay.t = after.t;
        EXPECT_NEAR(after.t - before.t, h, 1e-14);
      });
  EXPECT_GT(march.report().rejected, 0);
  EXPECT_GT(march.rungs().size(), 1U);
  EXPECT_EQ(end.t, 0.5);
  test::expect_same(end, replay);
}

TEST(TimeMarch, AQuarterOfTheToleranceGivesAQuarterOfTheError) {
  // Each step may use a fraction of the tolerance in proportion to its length: all errors add up to
  // no more than the tolerance, and fall with it. A step errs with h³, per time with h².
  const model::Model model = test::rigid_double_pendulum(true);
  const test::Start start = test::consistent_start(model);
  for (const Method method :
       {Method::generalized_alpha, Method::newmark, Method::hht, Method::wilson}) {
    const model::State exact =
        test::simulate(model, start, test::settings(Method::generalized_alpha, 1.0 / 16384), 1.0);
    const std::vector<double> tolerances = {4.096e-3, 1.024e-3, 2.56e-4, 6.4e-5, 1.6e-5};
    std::vector<double> errors;
    std::vector<long> steps;
    for (const double tolerance : tolerances) {
      TimeMarch march(model, test::settings(method, 1.0), start.rows_in_use,
                      controlled(1.0, tolerance));
      const model::State end = walk(march, start);
      errors.push_back((end.bodies[1].frame.X_WB.p - exact.bodies[1].frame.X_WB.p).norm());
      steps.push_back(march.report().accepted);
      // Local errors add up to the tolerance; the motion lets them grow by some factor.
      EXPECT_LT(errors.back(), 10.0 * tolerance * model.length) << to_string(method);
    }
    RecordProperty(to_string(method), testing::PrintToString(errors));
    // Over the whole range: 4⁴ = 256, within a factor of two; steps lie on a ladder, so single
    // ratios scatter. Errors of the longest steps are not yet those of the leading order.
    EXPECT_GT(errors[0] / errors[4], 100.0) << to_string(method);
    EXPECT_LT(errors[0] / errors[4], 512.0) << to_string(method);
    EXPECT_NEAR(static_cast<double>(steps[4]) / static_cast<double>(steps[0]), 16.0, 4.0);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_LT(errors[k + 1], 0.6 * errors[k]);
  }
}

/// Largest error of a run with step control, as multiples of the tolerance: of positions as a share
/// of the model's length, of rotations in rad, of deformations as a share of the largest.
double error_in_tolerances(const model::Model& model, double duration, double tolerance) {
  const test::Start start = test::consistent_start(model);
  StepSettings settings = test::settings(Method::generalized_alpha, duration);
  TimeMarch march(model, settings, start.rows_in_use, controlled(duration, tolerance));
  const model::State end = walk(march, start);
  const model::State exact = test::simulate(
      model, start, test::settings(Method::generalized_alpha, duration / 32768), duration);
  double out = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::BodyState& x = end.bodies[b];
    const model::BodyState& y = exact.bodies[b];
    out = std::max(out, (x.frame.X_WB.p - y.frame.X_WB.p).norm() / model.length);
    out = std::max(out, x.frame.X_WB.q.angularDistance(y.frame.X_WB.q));
    if (y.d.size() > 0) {
      out = std::max(out, (x.d.whole() - y.d.whole()).cwiseAbs().maxCoeff() /
                              y.d.whole().cwiseAbs().maxCoeff());
    }
  }
  return out / tolerance;
}

TEST(TimeMarch, TheToleranceIsTheErrorOfTheResult) {
  // Rigid and elastic, swinging and driven; ten times the tolerance is what the growth of early
  // errors in later motion may come to.
  test::BeamConstants damped = soft_beam();
  damped.beta = 2e-3;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    EXPECT_LT(error_in_tolerances(test::rigid_double_pendulum(true), 1.0, tolerance), 10.0);
    EXPECT_LT(error_in_tolerances(test::rigid_double_pendulum(false), 2.0, tolerance), 10.0);
    EXPECT_LT(error_in_tolerances(test::planar_beam_pendulum(damped), 1.0, tolerance), 10.0);
  }
}

/// A mass on a damped spring along x, at rest, pushed by 10 N from t = 0.5 s on.
model::Model pushed_mass() {
  test::Mechanism m(spatial::Plane::xy);
  m.set_length(1.0);
  const int mass =
      m.add_rigid(1.0, Eigen::Matrix3d::Identity(), {{1, 0, 0}, Eigen::Quaterniond::Identity()});
  const auto marker = m.rigid_marker(mass, {0, 0, 0});
  m.add_joint(joints::JointType::prismatic, test::Mechanism::ground({1, 0, 0}), marker,
              Eigen::Vector3d::UnitX());
  m.add_load(std::make_unique<loads::SpringDamper>(400.0, 20.0, 1.0, std::nullopt),
             test::Mechanism::ground({0, 0, 0}), marker);
  const auto push = base::TimeLaw::expression(base::Expression("t >= 0.5 ? 10 : 0", {"t"}, {}, {}));
  m.add_load(std::make_unique<loads::AppliedLoad>(
                 loads::AppliedLoad::Kind::force, loads::LoadAxes::fixed,
                 std::array<base::TimeLaw, 3>{push, base::TimeLaw{}, base::TimeLaw{}}),
             marker, test::Mechanism::ground({0, 0, 0}));
  return m.take();
}

TEST(TimeMarch, RefinesAtALoadJumpAndCoarsensAfterwards) {
  const model::Model model = pushed_mass();
  const test::Start start = test::consistent_start(model);
  TimeMarch march(model, StepSettings{}, start.rows_in_use, controlled(3.0, 1e-4));
  double before_jump = 0, at_jump = 1, at_end = 0;
  const model::State end = walk(march, start, [&](const model::State& a, const model::State& b) {
    const double h = b.t - a.t;
    if (b.t < 0.5) before_jump = std::max(before_jump, h);
    if (b.t >= 0.5 && a.t < 0.52) at_jump = std::min(at_jump, h);
    at_end = h;
  });
  // At rest the longest step H = T/20 does; the jump Δẍ = 10 m/s² may make the error of that step,
  // κ·6·h²Δẍ/6 < 1e-4/20: h ≈ 2 ms.
  EXPECT_EQ(before_jump, 3.0 / 20);
  EXPECT_LT(at_jump, 4e-3);
  EXPECT_GT(at_end, 16 * at_jump);
  // 10 N on 400 N/m.
  EXPECT_NEAR(end.bodies[0].frame.X_WB.p.x(), 1.025, 1e-6);
}

TEST(TimeMarch, AStepThatDoesNotSettleIsHalved) {
  const model::Model model = test::rigid_double_pendulum(true);
  const test::Start start =
      test::consistent_start(model, [](model::State& state) { state.bodies[1].frame.w.z() = 20; });
  StepSettings settings;
  settings.max_newton = 5;
  TimeMarch march(model, settings, start.rows_in_use, fixed(1.0, 25));
  const model::State end = walk(march, start);
  EXPECT_EQ(end.t, 1.0);
  EXPECT_GT(march.report().failed, 0);
  EXPECT_GT(march.rungs().size(), 1U);
  EXPECT_GT(march.rungs()[0].steps, 0) << "returns to the given step";
}

TEST(TimeMarch, GivesUpWithTheNameOfWhatResists) {
  const model::Model model = test::rigid_double_pendulum(true);
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.max_newton = 0;
  TimeMarch march(model, settings, start.rows_in_use, fixed(1.0, 10));
  model::State after;
  EXPECT_THAT(
      [&] { march.advance(start.state, after); },
      ThrowsMessage<NumericalError>(AllOf(HasSubstr("does not converge"), HasSubstr("joint \"j"),
                                          HasSubstr("shortened 8 times, down to 0.000391 s"))));
  EXPECT_EQ(march.report().failed, 9);
}

TEST(TimeMarch, KeepsNoMoreThanEightRungs) {
  const model::Model model = test::planar_beam_pendulum(soft_beam());
  StepSettings settings;
  settings.step = 0.01;
  StepLadder ladder(model, settings, {0, 1});
  for (int k = 0; k < 12; ++k) ladder.rung(k);
  EXPECT_EQ(ladder.counts(0).factorisations, 12);
  EXPECT_EQ(ladder.factorisations(0), 1);
  ladder.rung(11);  // still there
  EXPECT_EQ(ladder.counts(0).factorisations, 12);
  ladder.rung(0);  // given up and made again
  EXPECT_EQ(ladder.counts(0).factorisations, 13);
  EXPECT_EQ(ladder.factorisations(0), 2);
  EXPECT_DOUBLE_EQ(ladder.step(3), 0.00125);
}

/// Multipliers and accelerations half a step after a run of 0.5 s with steps h.
Vector after_change(const model::Model& model, const test::Start& start, double h, bool rescaled) {
  StepSettings settings = test::settings(Method::generalized_alpha, h);
  settings.rho_inf = 0.5;
  model::State state = start.state;
  Stepper whole(model, settings, start.rows_in_use);
  for (long k = 0; k < std::lround(0.5 / h); ++k) whole.step(state);
  settings.step = h / 2;
  Stepper half(model, settings, start.rows_in_use);
  if (!rescaled) state.last_step = settings.step;  // as if nothing had changed
  half.step(state);
  Vector out(state.lambda.size() + 4);
  out << state.lambda, state.bodies[0].v_dot.head<2>(), state.bodies[1].v_dot.head<2>();
  return out;
}

TEST(ChangeOfStep, RescaledAccelerationsKeepOrderTwo) {
  const model::Model model = test::rigid_double_pendulum(true);
  const test::Start start = test::consistent_start(model);
  const auto error = [&](double h, bool rescaled) {
    // The exact motion at the same instant, from steps 32 times shorter.
    StepSettings fine = test::settings(Method::generalized_alpha, h / 32);
    const model::State state = test::simulate(model, start, fine, 0.5 + h / 2);
    Vector exact(state.lambda.size() + 4);
    exact << state.lambda, state.bodies[0].v_dot.head<2>(), state.bodies[1].v_dot.head<2>();
    return (after_change(model, start, h, rescaled) - exact).norm();
  };
  const double h = 1.0 / 256;
  // Terms of third order are h of those of second: a few per cent.
  EXPECT_NEAR(test::observed_order(error(h, true), error(h / 2, true)), 2.0, 0.15);
  EXPECT_LT(test::observed_order(error(h, false), error(h / 2, false)), 1.3);
}

}  // namespace
}  // namespace buckens::verification::step_control
