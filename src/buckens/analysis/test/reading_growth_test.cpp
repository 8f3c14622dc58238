// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/reading_growth.h"

#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::analysis {
namespace {

/// A model with one reading, which a drive follows.
model::Model one_reading() {
  model::Model out;
  out.signals.all.resize(1);
  out.signals.all[0].name = "felt";
  out.signals.all[0].held = model::HeldReading{"cell", {}};
  out.signals.order = {0};
  out.signals.steering = {0};
  return out;
}

/// What is told of a law of the number of the step; empty: nothing in 2000 steps.
std::string told(const std::function<double(int)>& law) {
  const model::Model model = one_reading();
  ReadingGrowth growth(model);
  try {
    for (int n = 1; n <= 2000; ++n) growth.follow({1e-3 * n, law(n)});
  } catch (const NumericalError& error) {
    return error.what();
  }
  return {};
}

TEST(ReadingGrowth, NamesWhatChangesMoreWithEveryStep) {
  for (const double factor : {-1.1, -2.0, -100.0, 1.6, 3.0}) {
    const std::string text = told([factor](int n) { return 5.0 + 1e-6 * std::pow(factor, n); });
    EXPECT_NE(text.find("signal \"felt\", read from sensor \"cell\""), std::string::npos) << factor;
    EXPECT_NE(text.find(fmt::format("about {:.3g} times", factor)), std::string::npos) << text;
  }
  // Later in the run.
  EXPECT_NE(told([](int n) { return n < 1000 ? 9.81 : 9.81 + std::pow(-1.5, n - 1000); }), "");
}

TEST(ReadingGrowth, LetsBeWhatAMotionDoes) {
  // Resolved growth, as that of a mechanism that falls over.
  EXPECT_EQ(told([](int n) { return 1e-12 * std::exp(0.1 * n); }), "");
  EXPECT_EQ(told([](int n) { return std::sin(0.3 * n) * std::exp(0.1 * n); }), "");
  EXPECT_EQ(told([](int n) { return 1.0 * n * n * n; }), "");
  EXPECT_EQ(told([](int) { return 0.0; }), "");
  // To and fro, as of a method without damping, and as a feedback that settles.
  EXPECT_EQ(told([](int n) { return n % 2 == 0 ? 1e6 : -1e6; }), "");
  EXPECT_EQ(told([](int n) { return 1e9 * std::pow(-0.99, n); }), "");
  // A blow after rounding.
  EXPECT_EQ(told([](int n) { return n < 500 ? 1e-17 * std::pow(-1.1, n % 10) : 1e6; }), "");
  // Noise that grows, but to less than what the sensor has measured before.
  EXPECT_EQ(told([](int n) {
              return n < 100 ? 100.0 : 100.0 + 1e-12 * std::pow(-1.2, std::min(n - 100, 180));
            }),
            "");
}

TEST(ReadingGrowth, IsNotAskedWhereNothingFollowsSignals) {
  model::Model model = one_reading();
  model.signals.steering.clear();
  ReadingGrowth growth(model);
  for (int n = 0; n < 100; ++n) EXPECT_NO_THROW(growth.follow({1e-3 * n, std::pow(-2.0, n)}));
}

}  // namespace
}  // namespace buckens::analysis
