// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/drive_laws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

using base::TimeLaw;
using model::test::Described;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TimeLaw formula(const std::string& text) {
  return TimeLaw::expression(base::Expression(text, {"t"}, {}, {}));
}

/// A wheel that turns as the law says, for 0.1 s in steps of 1 ms.
Described wheel(const TimeLaw& angle) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
  m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
  m.joint<joints::PrescribedRotationSpec>("motor", "ground", "wheel").angle = angle;
  m.d.simulation.emplace();
  m.d.simulation->duration = 0.1;
  m.d.simulation->step = 1e-3;
  return m;
}

TEST(DriveLaws, AJumpEndsTheRunAndIsNamed) {
  for (const bool controlled : {false, true}) {
    Described m = wheel(formula("t < 0.0503 ? t : t + 0.2"));
    if (controlled) m.d.simulation->tolerance = 1e-5;
    results::Table table;
    EXPECT_THAT([&] { simulate(*m.build(), table); },
                ThrowsMessage<NumericalError>(
                    AllOf(HasSubstr("test.yaml:50"), HasSubstr("joint \"motor\""),
                          HasSubstr("t < 0.0503"), HasSubstr("jumps from 0.050"),
                          HasSubstr("to 0.2503 rad at t = 0.0503"), HasSubstr("ramp"))));
    // What came before is kept.
    EXPECT_GT(table.num_records(), 20U);
  }
}

TEST(DriveLaws, SmoothLawsAndRestAreNoJumps) {
  for (const char* text : {"sin(300*t)", "0.3*tanh(2000*(t - 0.05))", "1e-9*t^3", "t^2",
                           "cos(2*_pi*1000*t)", "t < 0.05 ? 0 : (t - 0.05)^2"}) {
    const Described m = wheel(formula(text));
    const DriveLaws laws(m.d);
    for (int k = 0; k < 100; ++k) EXPECT_NO_THROW(laws.check(1e-3 * k, 1e-3 * (k + 1))) << text;
  }
}

TEST(DriveLaws, WarnsOfTheCornersOfALinearTable) {
  const std::vector<double> times = {0, 0.02, 0.05, 0.2};
  const std::vector<double> angles = {0, 0.1, 0.4, 0.5};
  const auto warnings = [&](base::Interpolation interpolation, double duration) {
    return DriveLaws(wheel(TimeLaw::table(times, angles, interpolation)).d).corners(duration);
  };
  ASSERT_EQ(warnings(base::Interpolation::linear, 0.1).size(), 1U);
  EXPECT_THAT(
      warnings(base::Interpolation::linear, 0.1)[0],
      AllOf(HasSubstr("\"motor\""), HasSubstr("t = 0.02 s"), HasSubstr("interpolation: spline")));
  EXPECT_TRUE(warnings(base::Interpolation::linear, 0.01).empty()) << "before the first corner";
  EXPECT_TRUE(warnings(base::Interpolation::spline, 0.1).empty());
  const TimeLaw held =
      TimeLaw::table(times, angles, base::Interpolation::spline, base::Extrapolation::hold);
  EXPECT_THAT(DriveLaws(wheel(held).d).corners(0.3),
              testing::ElementsAre(AllOf(HasSubstr("t = 0.2 s"), HasSubstr("at rest"))));
  EXPECT_TRUE(DriveLaws(wheel(TimeLaw::constant(1)).d).corners(1).empty());
  // Points on one line have no corner between them.
  const TimeLaw line = TimeLaw::table({0, 0.03, 0.3}, {0, 0.3, 3}, base::Interpolation::linear);
  EXPECT_TRUE(DriveLaws(wheel(line).d).corners(0.1).empty());
}

TEST(DriveLaws, RefusesAnUnboundedSpeedAndWarnsOfAnUnboundedAccelerationAtTheStart) {
  for (const char* text : {"sqrt(t)", "3 + max(t, 0)^0.7", "sqrt(abs(t))"}) {
    EXPECT_THAT([&] { DriveLaws(wheel(formula(text)).d).check_start(0.2); },
                testing::ThrowsMessage<NumericalError>(
                    AllOf(HasSubstr("\"motor\""), HasSubstr("unbounded speed"))))
        << text;
  }
  for (const char* text : {"t^1.5", "max(t, 0)^1.5", "2*t + abs(t)^1.7"}) {
    EXPECT_THAT(
        DriveLaws(wheel(formula(text)).d).check_start(0.2),
        testing::ElementsAre(AllOf(HasSubstr("\"motor\""), HasSubstr("unbounded at t = 0"))))
        << text;
  }
  for (const char* text : {"150*t", "max(t, 0)", "3*t^2", "t^3", "sin(300*t)", "1 - cos(4000*t)",
                           "7", "1e6 + 1e-3*t", "t < 0.05 ? 0 : (t - 0.05)^1.5"}) {
    EXPECT_TRUE(DriveLaws(wheel(formula(text)).d).check_start(0.2).empty()) << text;
  }
}

TEST(DriveLaws, TheWarningReachesTheSummary) {
  const Described m =
      wheel(TimeLaw::table({0, 0.05, 0.2}, {0, 0.1, 0.1}, base::Interpolation::linear));
  results::Table table;
  const results::RunSummary summary = simulate(*m.build(), table);
  EXPECT_THAT(summary.warnings, testing::Contains(HasSubstr("velocity jumps")));
}

}  // namespace
}  // namespace buckens::analysis
