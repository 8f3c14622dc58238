// SPDX-License-Identifier: Apache-2.0
// The cost of the levels of coupling, and the accuracy of their results.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "buckens/analysis/simulation/coupling_watch.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/fem/mesh/box_mesh.h"
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
  // The error without iteration is far below that of the step; measured in README of the example.
  EXPECT_LT(of_iteration, 1e-3 * of_step);
  RecordProperty("of_iteration", std::to_string(of_iteration / of_step));
}

/// A steel block of 1 × 0.1 × 0.1 m on a ball joint at a corner, released from the horizontal: it
/// rings in bending at 366 Hz and above.
model::Model released_block(const std::array<int, 3>& divisions) {
  fem::Structure structure;
  fem::Box box;
  box.size = {1.0, 0.1, 0.1};
  box.divisions = divisions;
  fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850));
  test::Mechanism m;
  m.set_gravity({0, -9.81, 0});
  const int body = m.add_flexible(fem::assemble(structure), CouplingLevel::full, {});
  m.add_joint(joints::JointType::spherical, test::Mechanism::ground({0, 0, 0}),
              m.node_marker(body, 0));
  return m.take();
}

TEST(CouplingLevel, OneSolveErrsFarLessThanTheStepOnAReleasedBlock) {
  const model::Model model = released_block({12, 2, 2});
  const test::Start start = test::consistent_start(model);
  const auto tip = [&](double h, double tolerance, bool iterates, double& spin) {
    StepSettings settings;
    settings.step = h;
    settings.outer_tolerance = tolerance;
    settings.iterate_coupling = iterates;
    const model::State end = test::simulate(model, start, settings, 0.04);
    spin = end.bodies[0].frame.w.norm();
    return test::node_position(model, end, 0, 12);
  };
  constexpr double h = 1e-4;
  double spin = 0;
  const Eigen::Vector3d best = tip(h, 1e-12, true, spin);
  const double of_step = (tip(0.5 * h, 1e-12, true, spin) - best).norm();
  const double of_one = (tip(h, 1.0, false, spin) - best).norm();
  const double of_two = (tip(h, 1e-6, false, spin) - best).norm();
  RecordProperty("of_one", std::to_string(of_one / of_step));
  RecordProperty("of_two", std::to_string(of_two / of_step));
  // docs/theory/08-coupling.md: 12 |w| h of the error of the step, and that squared; the spin grows
  // evenly, |w| is its largest. Three quarters of the error of the step are seen at half its
  // length.
  const double share = 12.0 * spin * h;
  EXPECT_LT(of_one, 2.0 * share * of_step);
  EXPECT_LT(of_two, 0.05 * share * of_step);
}

TEST(CouplingLevel, DiagonalJudgesChangesOfTheLoadWithinAFactorOfTenOfTheWholeStepMatrix) {
  const model::Model model = released_block({12, 2, 2});
  const body::FlexiblePart& part = *model.bodies[0].flexible;
  const test::Start start = test::consistent_start(model);
  const StepSettings settings = test::settings(Method::generalized_alpha, 1e-4);
  Stepper stepper(model, settings, start.rows_in_use);
  stepping::BodyStepOperator op(part, stepper.scheme());
  model::State state = start.state;
  const auto by_matrix = [&](const linalg::Vector& f) {
    linalg::Vector x = f;
    op.solve(x);  // with the sieve: rigid motion is not the mesh's
    return std::sqrt(f.dot(x));
  };
  const auto by_diagonal = [&](const linalg::Vector& f) {
    return std::sqrt(f.cwiseAbs2().dot(op.K_hat_diagonal().cwiseInverse()));
  };
  double least = 1e300;
  for (int k = 0; k < 60; ++k) {
    const model::State before = state;
    stepper.step(state);
    if (k < 10) continue;
    model::Coupling extrapolated;
    dynamics::extrapolate(before.bodies[0], before.history, state.t, extrapolated);
    const linalg::Vector& load = state.bodies[0].coupling.load;
    const linalg::Vector whole =
        load + part.invariants.centrifugal_patterns() *
                   dynamics::centrifugal_weights({}, state.bodies[0].frame.w);
    const linalg::Vector change = load - extrapolated.load.whole();
    const double strict = by_diagonal(change) / by_diagonal(whole);
    const double exact = by_matrix(change) / by_matrix(whole);
    least = std::min(least, strict / exact);
  }
  RecordProperty("least", std::to_string(least));
  // The extrapolation error is of order (h ω)³: a factor of ten in the tolerance is one of two in
  // the admissible frequencies.
  EXPECT_GT(least, 0.1);
}

TEST(CouplingWatch, NeedsNoProductsAfterStepsWhoseBalanceIsKnown) {
  test::BeamConstants beam;
  beam.alpha = 0.5;
  beam.beta = 1e-4;
  const model::Model model = test::planar_beam_pendulum(beam, CouplingLevel::first_order);
  const test::Start start = test::consistent_start(model);
  const dynamics::MassMetric metric(model);
  const auto products = [&](Method method) {
    Stepper stepper(model, test::settings(method, 1e-3), start.rows_in_use);
    CouplingWatch watch(model, metric, start.rows_in_use);
    model::State state = start.state;
    watch.start(stepper, state);
    for (int k = 0; k < 50; ++k) {
      stepper.step(state);
      watch.after_step(stepper, state);
    }
    return watch.num_products();
  };
  EXPECT_EQ(products(Method::generalized_alpha), 0);
  EXPECT_EQ(products(Method::hht), 0);
  // Measured every ten steps, with K and C.
  EXPECT_EQ(products(Method::newmark), 10);
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

TEST(CouplingLevel, ASecondSolveThatMovesNothingTakesNoIteration) {
  // So stiff and short that its coupling load bends it by less than rounding of positions, as parts
  // of a body with many frames are.
  test::BeamConstants stiff;
  stiff.EA = 1e10;
  stiff.EIy = stiff.EIz = 1e8;
  stiff.elements = 1;
  const model::Model model = test::planar_beam_pendulum(stiff);
  const test::Start start = test::consistent_start(model);
  const auto effort = [&](double outer_tolerance) {
    StepSettings settings;
    settings.outer_tolerance = outer_tolerance;
    Stepper stepper(model, settings, start.rows_in_use);
    model::State state = start.state;
    std::array<long, 2> out = {0, 0};
    for (int k = 0; k < 200; ++k) {
      const StepReport report = stepper.step(state);
      out[0] += report.large_solve_rounds;
      out[1] += report.newton_iterations;
    }
    return out;
  };
  const auto [one, iterations] = effort(HUGE_VAL);
  const auto [two, iterations_of_two] = effort(1e-9);
  EXPECT_EQ(one, 200);
  EXPECT_GE(two, 300);
  EXPECT_EQ(iterations_of_two, iterations);
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
    state.bodies[0].d.change()[dofs[0][0]] = -0.3;
    state.bodies[0].d.change()[dofs[1][0]] = 0.3;
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
