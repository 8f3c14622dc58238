// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/signal_growth.h"

#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace buckens::analysis {
namespace {

constexpr double kStep = 1e-3;
const NumericalError kFailure("step failed");

/// A model with one signal, which a drive follows.
model::Model one_signal() {
  model::Model out;
  out.signals.all.resize(1);
  out.signals.all[0].name = "u";
  out.signals.order = {0};
  out.signals.steering = {0};
  return out;
}

/// What the failure says after a second in which the signal has followed a law; empty: no more.
std::string named(const std::function<double(double)>& law) {
  const model::Model model = one_signal();
  SignalGrowth growth(model);
  for (int n = 0; n <= 1000; ++n) growth.follow({n * kStep, law(n * kStep)});
  try {
    growth.check_failed(kFailure);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return {};
}

TEST(SignalGrowth, NamesWhatGrowsExponentially) {
  for (const double rate : {15.0, 100.0, 600.0}) {
    const std::string text = named([rate](double t) { return -1e-3 * std::exp(rate * t); });
    EXPECT_NE(text.find("signal \"u\" has grown exponentially"), std::string::npos) << rate;
    EXPECT_NE(text.find("step failed"), std::string::npos);
  }
  // An oscillation, of which only the peaks grow.
  EXPECT_NE(named([](double t) { return std::exp(20 * t) * std::sin(150 * t); }), "");
  // Beyond what a number holds.
  EXPECT_NE(named([](double t) { return std::exp(800 * t); }), "");
  // After a long rest.
  EXPECT_NE(named([](double t) { return 1.0 + std::exp(400 * (t - 0.95)); }), "");
}

TEST(SignalGrowth, LetsBeWhatDoesNot) {
  for (const double power : {1.0, 2.0, 4.0}) {
    EXPECT_EQ(named([power](double t) { return std::pow(t, power); }), "") << power;
  }
  EXPECT_EQ(named([](double t) { return t < 0.5 ? 0.0 : 1e6; }), "");
  EXPECT_EQ(named([](double t) { return t < 0.5 ? 1e-3 : 1.0; }), "");
  EXPECT_EQ(named([](double t) { return t < 0.5 ? 0.0 : 1.0 - std::exp(-3 * (t - 0.5)); }), "");
  EXPECT_EQ(named([](double t) { return 5 * std::sin(30 * t); }), "");
  EXPECT_EQ(named([](double) { return 0.0; }), "");
  EXPECT_EQ(named([](double t) { return t < 0.9 ? t : HUGE_VAL; }), "");
}

TEST(SignalGrowth, LeavesFailuresAloneThatHaveNamedTheirCause) {
  const model::Model model = one_signal();
  SignalGrowth growth(model);
  for (int n = 0; n <= 100; ++n) growth.follow({n * kStep, std::exp(0.2 * n)});
  SourceLocation where;
  where.file = "model.yaml";
  where.line = 3;
  EXPECT_NO_THROW(growth.check_failed(NumericalError(where, "a law jumps")));
  EXPECT_THROW(growth.check_failed(kFailure), NumericalError);
}

TEST(SignalGrowth, IsNotAskedWhereNothingFollowsSignals) {
  model::Model model = one_signal();
  model.signals.steering.clear();
  SignalGrowth growth(model);
  for (int n = 0; n <= 100; ++n) growth.follow({n * kStep, std::exp(0.2 * n)});
  EXPECT_NO_THROW(growth.check_failed(kFailure));
}

}  // namespace
}  // namespace buckens::analysis
