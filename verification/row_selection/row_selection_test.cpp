// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/analysis/initial/prepare.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model_file/model_file.h"
#include "buckens/stepping/stepper.h"

namespace buckens::verification::row_selection {
namespace {

using Eigen::Vector3d;

constexpr const char* kCranks = R"(
buckens: 1
planar: xy
bodies:
  first: {rigid: {mass: 1 kg, com: [0.1 m, 0, 0], inertia: [0, 0, 0.01 kg m^2]},
          at: {orientation: {axis: [0, 0, 1], angle: 30.8 deg}},
          markers: {pin: {position: [0.2 m, 0, 0]}}}
  second: {like: first, at: {position: [1 m, 0, 0], orientation: {axis: [0, 0, 1], angle: 30.8 deg}}}
  third: {like: first, at: {position: [2 m, 0, 0], orientation: {axis: [0, 0, 1], angle: 30.8 deg}}}
  coupler:
    rigid: {mass: 2 kg, com: [1 m, 0, 0], inertia: [0, 0, 0.5 kg m^2]}
    at: {position: ["0.2*cos(30.8*pi/180) m", "0.2*sin(30.8*pi/180) m", 0]}
    markers: {a: {position: [0, 0, 0]}, b: {position: [1 m, 0, 0]}, c: {position: [2 m, 0, 0]}}
joints:
  motor: {prescribed-rotation: {between: [ground, first/origin], axis: [0, 0, 1], angle: "320*t deg"}}
  foot_a: {revolute: {between: [ground, first/origin]}}
  foot_b: {revolute: {between: [{ground: [1 m, 0, 0]}, second/origin]}}
  foot_c: {revolute: {between: [{ground: [2 m, 0, 0]}, third/origin]}}
  pin_a: {revolute: {between: [first/pin, coupler/a]}}
  pin_b: {revolute: {between: [second/pin, coupler/b]}}
  pin_c: {revolute: {between: [third/pin, coupler/c]}}
initial:
  bodies:
    first: {angular-velocity: [0, 0, 320 deg/s]}
simulation: {duration: 2 s, step: 5 ms}
)";

// Joints are closed to rounding by the position rows; rows not in use follow geometrically.
constexpr double kClosed = 1e-12;

TEST(RowSelection, ParallelCranksHandOverFromRowToRow) {
  const auto built = model::build_model(model_file::read_model_text(kCranks, "cranks.yaml"));
  const dynamics::MassMetric metric(built->model);
  analysis::Prepared prepared = analysis::prepare(*built, metric);
  EXPECT_EQ(prepared.redundant_rows.size(), 1U);
  stepping::StepSettings settings;
  settings.step = 5e-3;
  stepping::Stepper stepper(built->model, settings, prepared.rows_in_use);
  model::State& state = prepared.state;
  // 1.6 degrees a step: one step ends with the cranks upright, none with all bodies on a line,
  // which is a dead centre that no choice of equations can pass.
  for (int step = 1; step <= 400; ++step) {
    const stepping::StepReport report = stepper.step(state);
    state.t = step * settings.step;
    ASSERT_LT(report.position_residual, kClosed) << "t = " << state.t;
    const double angle = M_PI / 180 * (30.8 + 320 * state.t);
    const Vector3d expected(1.0 + 0.2 * std::cos(angle), 0.2 * std::sin(angle), 0);
    const auto& coupler = state.bodies[3].frame;
    // All motion follows from the joints alone.
    ASSERT_LT((coupler.X_WB.p - expected).norm(), 1e-11) << "t = " << state.t;
    ASSERT_LT(std::abs(coupler.w.z()), 1e-9);
  }
  EXPECT_GT(stepper.num_row_selections(), 0);
}

}  // namespace
}  // namespace buckens::verification::row_selection
