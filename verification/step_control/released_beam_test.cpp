// SPDX-License-Identifier: Apache-2.0
// An undamped flexible body released from rest: all its vibrations set in at once; see README.md.
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/step_control/walk.h"

#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::step_control {
namespace {

using linalg::Vector;
using stepping::Method;

constexpr long kInstants = 20;  // at which deformations are compared

/// Rod of aluminium, 0.3 m by 10 mm by 10 mm.
test::BeamConstants thin_rod() {
  test::BeamConstants rod;
  rod.L = 0.3;
  rod.rhoA = 0.27;
  rod.EA = 7e6;
  rod.EIy = rod.EIz = 58.333;
  rod.elements = 6;
  return rod;
}

/// Lowest bending frequency of a rod that turns freely about one end [rad/s].
double first_frequency(const test::BeamConstants& rod) {
  return std::pow(3.9266 / rod.L, 2) * std::sqrt(rod.EIz / rod.rhoA);
}

/// Deformations at all instants, by 4096 steps between two of them.
std::vector<Vector> fine_deformations(const model::Model& model, const test::Start& start,
                                      double duration) {
  constexpr long kSteps = 4096;
  const double h = duration / static_cast<double>(kInstants * kSteps);
  stepping::Stepper stepper(model, test::settings(Method::generalized_alpha, h), start.rows_in_use);
  model::State state = start.state;
  std::vector<Vector> out;
  for (long k = 1; k <= kInstants * kSteps; ++k) {
    stepper.step(state);
    if (k % kSteps == 0) out.push_back(state.bodies[0].d);
  }
  return out;
}

struct ControlledRun {
  double error = 0;  ///< largest, as a share of the largest deformation
  long steps = 0;    ///< tried
};

ControlledRun compared_run(const model::Model& model, const test::Start& start, double duration,
                           double tolerance, const std::vector<Vector>& exact) {
  stepping::TimeMarch march(model, test::settings(Method::generalized_alpha, duration),
                            start.rows_in_use, controlled(duration, tolerance));
  double error = 0, largest = 0;
  std::size_t next = 0;
  walk(march, start, [&](const model::State&, const model::State& after) {
    // Longest steps end at the instants, so that shorter ones meet them exactly.
    const double instant = duration * static_cast<double>(next + 1) / kInstants;
    if (after.t < instant - 1e-9 * duration) return;
    error = std::max(error, (after.bodies[0].d.whole() - exact[next]).cwiseAbs().maxCoeff());
    largest = std::max(largest, exact[next].cwiseAbs().maxCoeff());
    ++next;
  });
  EXPECT_EQ(next, exact.size());
  return {error / largest, march.report().accepted + march.report().rejected};
}

TEST(ReleasedBeam, StepsFollowTheVibrationsThatMatter) {
  const test::BeamConstants rod = thin_rod();
  const model::Model model = test::planar_beam_pendulum(rod);
  const test::Start start = test::consistent_start(model);
  const double duration = 0.02;  // eight periods
  const double radians = first_frequency(rod) * duration;
  const std::vector<Vector> exact = fine_deformations(model, start, duration);
  std::vector<double> errors;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const ControlledRun run = compared_run(model, start, duration, tolerance, exact);
    RecordProperty(fmt::format("tolerance {}", tolerance),
                   fmt::format("error {:.3g}, {} steps", run.error, run.steps));
    // (ωh)²/12 = τ/10 for the first vibration. The faster ones, and trials, may take as many again;
    // errors that were to add up to τ over the run took thirty times as many.
    EXPECT_LT(static_cast<double>(run.steps), 2.0 * radians / std::sqrt(1.2 * tolerance));
    // Each vibration errs by τ/10 per radian. Those above the fifth, which is 17.6 times as fast as
    // the first, stay below a thousandth of it.
    EXPECT_LT(run.error, 0.1 * tolerance * 17.6 * radians);
    errors.push_back(run.error);
  }
  // Of the first vibration alone 5 τ; its error is most of the whole where the others are small.
  EXPECT_LT(errors[0], 0.1);
  // The fine run errs by 3e-4. Smaller vibrations are followed as the tolerance falls: the error
  // falls more slowly than it.
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_LT(errors[2], 0.6 * errors[1]);
}

TEST(ReleasedBeam, WithDampingTheToleranceIsTheErrorOfTheDeformation) {
  test::BeamConstants rod = thin_rod();
  rod.beta = 1e-4;  // 13 % of critical damping in the first vibration
  const model::Model model = test::planar_beam_pendulum(rod);
  const test::Start start = test::consistent_start(model);
  const std::vector<Vector> exact = fine_deformations(model, start, 0.02);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    // It remembers the errors of eight radians; the second vibration adds its own.
    const ControlledRun run = compared_run(model, start, 0.02, tolerance, exact);
    RecordProperty(fmt::format("tolerance {}", tolerance),
                   fmt::format("error {:.3g}, {} steps", run.error, run.steps));
    EXPECT_LT(run.error, 4.0 * tolerance);
  }
}

}  // namespace
}  // namespace buckens::verification::step_control
