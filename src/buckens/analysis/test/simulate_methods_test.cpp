// SPDX-License-Identifier: Apache-2.0
// Methods and step control as requested in a model file.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

using model::IntegrationMethod;
using model::test::Described;
using results::RunSummary;
using results::Table;

/// Rigid rod on a pin, J/(m l g) chosen for a small-angle ω of 2π: released 0.1 rad from the
/// vertical.
Described pendulum() {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.d.gravity = {0, -10, 0};
  const double tilt = 0.1;
  m.rigid("bob", 1, {std::sin(tilt), -std::cos(tilt), 0}, {0, 0, 1}).markers = {
      Described::marker("pin", {0, 0, 0})};
  m.joint<joints::RevoluteSpec>("hinge", "ground", "bob/pin");
  m.sensor<model::PositionSensor>("bob").of = model::test::at_marker("bob");
  m.sensor<model::JointForceSensor>("bearing").joint = "hinge";
  m.d.simulation.emplace();
  m.d.simulation->duration = 2.0;
  m.d.output.every = 0.1;
  return m;
}

RunSummary run(const Described& m, Table& table) { return simulate(*m.build(), table); }

TEST(SimulateMethods, AllEndInTheSameMotion) {
  Table exact;
  Described m = pendulum();
  m.d.simulation->step = 1e-4;
  run(m, exact);
  for (const auto method : {IntegrationMethod::generalized_alpha, IntegrationMethod::newmark,
                            IntegrationMethod::hht, IntegrationMethod::wilson}) {
    SCOPED_TRACE(static_cast<int>(method));
    m.d.simulation->method = method;
    m.d.simulation->step = 2e-3;
    Table table;
    const RunSummary summary = run(m, table);
    EXPECT_EQ(summary.steps, 1000);
    EXPECT_FALSE(summary.step_control.is_controlled);
    EXPECT_EQ(summary.step_control.smallest, 2e-3);
    ASSERT_EQ(summary.step_control.sizes.size(), 1U);
    // Phase error (ωh)²/12 · ωt of 0.1 m with ω = √5: below 1e-6 m, ten times that for HHT and
    // Wilson; forces vary with it by 10 N/m.
    const Eigen::MatrixXd way = table.values("sensors/bob") - exact.values("sensors/bob");
    EXPECT_LT(way.cwiseAbs().maxCoeff(), 1e-5);
    const Eigen::MatrixXd force = table.values("sensors/bearing") - exact.values("sensors/bearing");
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT(summary.energy_error, 1e-4);
    EXPECT_LT(summary.residuals.position, 1e-12);
  }
}

TEST(SimulateMethods, AutomaticStepsKeepRecordsAndReportThemselves) {
  Table exact;
  Described m = pendulum();
  m.d.simulation->step = 1e-4;
  run(m, exact);
  m.d.simulation->step = 0.0;  // auto
  Table table;
  const RunSummary summary = run(m, table);
  EXPECT_TRUE(summary.finished);
  EXPECT_EQ(summary.end_time, 2.0);
  ASSERT_EQ(table.num_records(), exact.num_records());
  const Eigen::MatrixXd way = table.values("sensors/bob") - exact.values("sensors/bob");
  // About a hundred steps, each with 1e-5 of the size (1 m) at most.
  EXPECT_LT(way.cwiseAbs().maxCoeff(), 1e-3);
  const results::StepControlEffort& control = summary.step_control;
  EXPECT_TRUE(control.is_controlled);
  EXPECT_EQ(control.failed, 0);
  EXPECT_LE(control.smallest, control.largest);
  EXPECT_LE(control.largest, 0.02);  // a hundredth of the duration
  long steps = 0;
  for (const results::StepSizeEffort& size : control.sizes) steps += size.steps;
  EXPECT_EQ(steps, summary.steps);
}

TEST(SimulateMethods, AToleranceTakesTheStepAsTheLongest) {
  Described m = pendulum();
  m.d.simulation->step = 5e-3;
  m.d.simulation->tolerance = 0.05;
  Table table;
  const RunSummary summary = run(m, table);
  EXPECT_TRUE(summary.step_control.is_controlled);
  EXPECT_EQ(summary.steps, 400);
  EXPECT_EQ(summary.step_control.largest, 5e-3);
  m.d.simulation->tolerance = 1e-8;
  Table fine;
  EXPECT_LT(run(m, fine).step_control.smallest, 5e-3);
}

TEST(SimulateMethods, DriveWorkIsCountedWithEveryMethod) {
  // A wheel of 0.5 kg m² turns by sin²: all its energy comes from the drive.
  for (const auto method : {IntegrationMethod::generalized_alpha, IntegrationMethod::newmark,
                            IntegrationMethod::hht, IntegrationMethod::wilson}) {
    SCOPED_TRACE(static_cast<int>(method));
    Described m;
    m.d.planar = spatial::Plane::xy;
    m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
    m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
    m.joint<joints::PrescribedRotationSpec>("motor", "ground", "wheel").angle =
        base::TimeLaw::expression(base::Expression("sin(3*t)^2", {"t"}, {}, {}));
    m.d.simulation.emplace();
    m.d.simulation->duration = 1.0;
    m.d.simulation->step = 1e-3;
    m.d.simulation->method = method;
    Table table;
    // (ωh)² = 4e-5 with the drive's ω = 6/s.
    EXPECT_LT(run(m, table).energy_error, 1e-4);
  }
}

}  // namespace
}  // namespace buckens::analysis
