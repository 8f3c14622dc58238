// SPDX-License-Identifier: Apache-2.0
// What the levels of coupling cost, and that their answers hold.
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::analysis {
namespace {

using body::CouplingChoice;
using body::CouplingLevel;
using body::CouplingTerm;
using stepping::Method;
using stepping::Stepper;
using stepping::StepReport;
using stepping::StepSettings;

/// Large solves of body `b` in each of `steps` steps.
long solves(const model::Model& model, const test::Start& start, const StepSettings& settings,
            int steps, std::size_t b = 0) {
  Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < steps; ++k) {
    const long before = stepper.counts(b).solves;
    const StepReport report = stepper.step(state);
    EXPECT_EQ(stepper.counts(b).solves - before, report.large_solve_rounds);
  }
  EXPECT_EQ(stepper.counts(b).factorisations, 1);
  return stepper.counts(b).solves;
}

TEST(CouplingLevel, FirstOrderTakesExactlyOneLargeSolvePerStep) {
  test::BeamConstants beam;
  beam.EA = 1e4;
  beam.EIy = beam.EIz = 30;
  for (const CouplingLevel level : {CouplingLevel::none, CouplingLevel::first_order}) {
    const model::Model plane = test::planar_beam_pendulum(beam, level);
    const model::Model space = test::spatial_beam_pendulum(beam, level);
    const test::Start spinning = test::consistent_start(space, [](model::State& state) {
      body::FrameMotion& frame = state.bodies[0].frame;
      frame.w << 3, -1, 4;
      frame.v = frame.w.cross(frame.X_WB.p);
    });
    for (const Method method : {Method::generalized_alpha, Method::newmark}) {
      const StepSettings settings = test::settings(method, 1e-3);
      EXPECT_EQ(solves(plane, test::consistent_start(plane), settings, 300), 300);
      EXPECT_EQ(solves(space, spinning, settings, 300), 300);
    }
  }
}

TEST(CouplingLevel, TermsOfTheFrameEquationAloneTakeOneLargeSolve) {
  // They are repeated with a small Newton only.
  const CouplingChoice frame_only(
      CouplingLevel::full, {CouplingTerm::cent1, CouplingTerm::cor_fe, CouplingTerm::eul_fe});
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{}, frame_only);
  const StepSettings settings = test::settings(Method::generalized_alpha, 1e-3);
  EXPECT_EQ(solves(model, test::consistent_start(model), settings, 100), 100);
}

TEST(CouplingLevel, FullTakesAtMostTwoLargeSolvesOnTheSliderCrank) {
  const model::Model model = test::slider_crank(16);
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 5e-5;
  const long count = solves(model, start, settings, 400, 1);
  EXPECT_LE(count, 800);
  RecordProperty("solves_per_step", std::to_string(static_cast<double>(count) / 400));
}

/// Bending of the rod's middle after 400 steps of 50 µs.
double bending(const StepSettings& settings) {
  const model::Model model = test::slider_crank(16);
  const test::Start start = test::consistent_start(model);
  const model::State end = test::simulate(model, start, settings, 0.02);
  // Nodes are numbered start, end, then between: the middle of 16 elements is node 2 + 7.
  const auto at = [&](std::size_t node) { return test::node_position(model, end, 1, node); };
  const Eigen::Vector3d chord = at(1) - at(0);
  return chord.cross(at(9) - at(0)).norm() / chord.norm();
}

TEST(CouplingLevel, TwoSolvesGiveTheFullyIteratedAnswer) {
  StepSettings two;
  two.step = 5e-5;
  StepSettings iterated = two;
  iterated.iterate_coupling = true;
  iterated.outer_tolerance = 1e-12;
  StepSettings finer = iterated;
  finer.step = 2.5e-5;
  const double best = bending(iterated);
  const double of_iteration = std::abs(bending(two) - best);
  const double of_step = std::abs(bending(finer) - best);
  // The error of not iterating lies far below that of the step; measured in README of the example.
  EXPECT_LT(of_iteration, 1e-3 * of_step);
  RecordProperty("of_iteration", std::to_string(of_iteration / of_step));
}

/// Elongation and angle of a free bar of 1 kg and 1 m after `duration`, by Runge–Kutta: it turns
/// with J(e) φ̇ = H, J = (1 + e)²/12, and stretches with ë/12 + EA e = (1 + e) φ̇²/12.
Eigen::Vector2d spinning_bar(double EA, double e0, double w0, double duration) {
  const double H = (1 + e0) * (1 + e0) / 12 * w0;
  const auto rate = [&](const Eigen::Vector3d& x) {
    const double w = 12 * H / ((1 + x[0]) * (1 + x[0]));
    return Eigen::Vector3d(x[1], (1 + x[0]) * w * w - 12 * EA * x[0], w);
  };
  Eigen::Vector3d x(e0, 0, 0);
  constexpr int kSteps = 20000;
  const double dt = duration / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const Eigen::Vector3d k1 = rate(x);
    const Eigen::Vector3d k2 = rate(x + 0.5 * dt * k1);
    const Eigen::Vector3d k3 = rate(x + 0.5 * dt * k2);
    const Eigen::Vector3d k4 = rate(x + dt * k3);
    x += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {x[0], x[2]};
}

TEST(CouplingLevel, IterationConvergesOnABarStretchedBySixtyPercent) {
  // J(e) is up to 2.56 J₀: with J − J₀ on the right-hand side the iteration would grow by 1.56 each
  // time, whatever the step.
  constexpr double kEA = 50;
  constexpr double kSpin = 5;
  test::BeamConstants constants;
  constants.EA = kEA;
  constants.elements = 1;
  test::Mechanism m(spatial::Plane::xy);
  m.add_flexible(test::straight_beam(constants, spatial::Plane::xy), CouplingLevel::full, {});
  const model::Model model = m.take();
  const auto& dofs = model.bodies[0].flexible->fe.dofs.node_dofs;
  const test::Start start = test::consistent_start(model, [&](model::State& state) {
    state.bodies[0].frame.w << 0, 0, kSpin;
    state.bodies[0].d[dofs[0][0]] = -0.3;
    state.bodies[0].d[dofs[1][0]] = 0.3;
  });
  const Eigen::Vector2d expected = spinning_bar(kEA, 0.6, kSpin, 0.2);
  for (const Method method : {Method::generalized_alpha, Method::newmark}) {
    std::vector<double> errors;
    for (const double h : {4e-4, 2e-4}) {
      StepSettings settings;
      settings.method = method;
      settings.step = h;
      settings.rho_inf = 1.0;
      Stepper stepper(model, settings, start.rows_in_use);
      model::State state = start.state;
      for (long k = std::lround(0.2 / h); k > 0; --k) {
        EXPECT_LE(stepper.step(state).large_solve_rounds, 3);  // 3: in the first steps
      }
      const double e = state.bodies[0].d[dofs[1][0]] - state.bodies[0].d[dofs[0][0]];
      const Eigen::Quaterniond& q = state.bodies[0].frame.X_WB.q;
      const double angle = 2.0 * std::atan2(q.z(), q.w());
      errors.push_back(std::max(std::abs(e - expected[0]), std::abs(angle - expected[1])));
    }
    // Errors of the step alone: five radians of a vibration with h ω = 0.005.
    EXPECT_LT(errors[1], 2e-5);
    EXPECT_NEAR(test::observed_order(errors[0], errors[1]), 2.0, 0.1);
  }
}

}  // namespace
}  // namespace buckens::analysis
