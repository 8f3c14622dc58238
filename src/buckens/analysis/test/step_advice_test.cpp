// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/step_advice.h"

#include <cmath>
#include <numbers>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace buckens::analysis {
namespace {

/// The step that a warning advises [s].
double advised(const std::string& warning) {
  std::smatch found;
  return std::regex_search(warning, found, std::regex("use a step of ([0-9.e-]+) s"))
             ? std::stod(found[1])
             : NAN;
}

TEST(StepAdvice, NamesAStepThatIsShortEnough) {
  // Whatever digits twelve steps per period have, two of them do not round up beyond it.
  for (double period = 1e-4; period < 1e-2; period *= 1.037) {
    ExcitedBand band;
    const double omega = 2.0 * std::numbers::pi / period;
    band.first = band.highest = omega;
    band.excited = {omega};
    const double longest = period / 12.0;
    const double step = advised(judge_step("rod", band, 1.01 * longest, 1e-5));
    EXPECT_LE(step, longest * (1.0 + 1e-12)) << period;
    EXPECT_GE(step, 0.9 * longest) << period;
    EXPECT_EQ(judge_step("rod", band, step, 1e-5), "") << period;
  }
}

}  // namespace
}  // namespace buckens::analysis
