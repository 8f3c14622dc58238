// SPDX-License-Identifier: Apache-2.0
// Uncertainties from curves whose errors are known.
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "buckens/analysis/error/estimate.h"
#include "buckens/analysis/error/runs.h"

namespace buckens::analysis {
namespace {

using results::ErrorStatement;
using results::SensorErrors;

/// Sensors "tip" with components x and y over ten seconds.
std::unique_ptr<SensorCurves> curves(const std::function<double(double)>& x,
                                     const std::function<double(double)>& y, double every = 0.05) {
  results::RecordLayout layout;
  layout.add({"sensors/tip", "m", {2}, "", {"x", "y"}});
  auto out = std::make_unique<SensorCurves>();
  out->begin(layout, {});
  for (int k = 0; k * every <= 10.0 + 1e-9; ++k) {
    out->write({k * every, {x(k * every), y(k * every)}});
  }
  results::RunSummary summary;
  summary.steps = 100;
  out->finish(summary);
  return out;
}

const SensorErrors& find(const ErrorStatement& statement, const std::string& name) {
  for (const SensorErrors& sensor : statement.sensors) {
    if (sensor.name == name) return sensor;
  }
  throw std::out_of_range(name);
}

results::ErrorSource half_step() {
  return {results::kTimeStepSource, "half the step", 2, two_grid_factor(2), 0, 0};
}

double none(double) { return 0.0; }

TEST(ErrorEstimate, IsThreeTimesTheErrorOfOrderTwo) {
  // x = (1 + e) sin t, e = 1e-3 in the run and a quarter of that in the further one.
  const auto run = curves([](double t) { return 1.001 * std::sin(t); }, none);
  const auto further = curves([](double t) { return 1.00025 * std::sin(t); }, none);
  ErrorEstimate estimate(*run);
  estimate.add(half_step(), *further);
  const SensorErrors x = find(estimate.statement(), "tip.x");
  // The vertex of a parabola through three records of sin t: relative error (0.05)⁴/24 at most.
  EXPECT_NEAR(std::abs(x.peak.value), 1.001, 3e-7);
  EXPECT_LT(x.sampling, 3e-6);
  EXPECT_GT(x.sampling, std::abs(std::abs(x.peak.value) - 1.001));
  EXPECT_NEAR(x.peak.uncertainty, 3e-3 + x.sampling, 1e-8);
  EXPECT_NEAR(x.last.uncertainty, 3e-3 * std::abs(std::sin(10.0)), 1e-8);
  EXPECT_NEAR(x.curve.uncertainty, 3e-3, 3e-6);  // the largest record, not the vertex
  EXPECT_TRUE(x.is_resolved);
}

TEST(ErrorEstimate, PhaseShowsInTheCurveAndNotInThePeak) {
  const auto run = curves([](double t) { return std::sin(1.01 * t); }, none);
  const auto further = curves([](double t) { return std::sin(1.0025 * t); }, none);
  ErrorEstimate estimate(*run);
  estimate.add(half_step(), *further);
  const SensorErrors x = find(estimate.statement(), "tip.x");
  EXPECT_LT(x.peak.uncertainty, 1e-5);
  EXPECT_GT(x.curve.uncertainty, 4 * 0.07);  // 0.0075 t cos t near t = 3π
}

TEST(ErrorEstimate, APeakIsSoughtOnItsOwnSide) {
  // Of two equal extremes the further run must not pick the other one.
  const auto run = curves([](double t) { return std::cos(t) + 1e-6; }, none);
  const auto further = curves([](double t) { return std::cos(t) - 1e-6; }, none);
  ErrorEstimate estimate(*run);
  estimate.add(half_step(), *further);
  const SensorErrors x = find(estimate.statement(), "tip.x");
  EXPECT_NEAR(x.peak.uncertainty, 8e-6 + 1e-9 + x.sampling, 1e-10);
}

TEST(ErrorEstimate, NothingIsBetterThanTheIterations) {
  const auto run = curves([](double) { return 2.0; }, none);
  ErrorEstimate estimate(*run);
  estimate.add(half_step(), *run);
  const ErrorStatement statement = estimate.statement();
  EXPECT_DOUBLE_EQ(find(statement, "tip.x").peak.uncertainty, 2e-9);
  // A component that stays zero has the scale of its sensor.
  EXPECT_DOUBLE_EQ(find(statement, "tip.y").peak.uncertainty, 2e-9);
  EXPECT_TRUE(find(statement, "tip.x").is_resolved);
  EXPECT_TRUE(doubts(statement).empty());
}

TEST(ErrorEstimate, CurvesThatPartAreNotResolved) {
  const auto run = curves([](double t) { return std::sin(t * t); }, none);
  const auto further = curves([](double t) { return std::sin(1.1 * t * t); }, none);
  ErrorEstimate estimate(*run);
  estimate.add(half_step(), *further);
  EXPECT_FALSE(find(estimate.statement(), "tip.x").is_resolved);
  ASSERT_FALSE(doubts(estimate.statement()).empty());
  EXPECT_NE(doubts(estimate.statement())[0].find("tip.x"), std::string::npos);
}

TEST(ErrorEstimate, PartsAddUpAndTheLargestIsNamed) {
  const auto run = curves([](double t) { return t; }, none);
  const auto finer = curves([](double t) { return 1.001 * t; }, none, 0.125);
  const auto stiffer = curves([](double t) { return 0.9 * t; }, none);
  ErrorEstimate estimate(*run);
  estimate.add(half_step(), *finer);
  estimate.add({"frames", "twice as many body frames", 2, two_grid_factor(2), 0, 0}, *stiffer);
  const ErrorStatement statement = estimate.statement();
  const SensorErrors x = find(statement, "tip.x");
  ASSERT_EQ(x.last.parts.size(), 2U);
  EXPECT_NEAR(x.last.parts[0], 0.04, 1e-12);
  EXPECT_NEAR(x.last.parts[1], 4.0, 1e-12);
  EXPECT_NEAR(x.last.uncertainty, 4.04, 2e-8);
  EXPECT_DOUBLE_EQ(x.curve.at, 10.0);
  const auto reasons = doubts(statement);
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_NE(reasons[0].find("due to frames"), std::string::npos);
}

TEST(ErrorEstimate, FactorsAreThoseOfRoache) {
  EXPECT_DOUBLE_EQ(two_grid_factor(2), 4.0);
  EXPECT_DOUBLE_EQ(two_grid_factor(1.5), 5.4);
}

}  // namespace
}  // namespace buckens::analysis
