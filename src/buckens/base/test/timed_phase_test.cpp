// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/timed_phase.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace buckens::base {
namespace {

void pass(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

double total(const PhaseSeconds& phases) {
  double out = 0;
  for (const auto& phase : phases) out += phase.second;
  return out;
}

TEST(TimedPhase, CountsForItselfWhatIsWithinAnother) {
  take_phases();
  const Stopwatch watch;
  {
    const TimedPhase outer("outer");
    pass(2);
    for (int k = 0; k < 2; ++k) {
      const TimedPhase inner("inner");
      pass(20);
    }
  }
  const double all = watch.seconds();
  const PhaseSeconds phases = take_phases();
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_EQ(phases[0].first, "outer");
  EXPECT_EQ(phases[1].first, "inner");
  EXPECT_GE(phases[1].second, 0.040);
  EXPECT_GE(phases[0].second, 0.002);
  EXPECT_LE(total(phases), all) << "nothing counts twice";
  EXPECT_TRUE(take_phases().empty());
}

TEST(TimedPhase, BelongsToItsThread) {
  take_phases();
  const TimedPhase mine("mine");
  std::thread other([] {
    { const TimedPhase its("its"); }
    const PhaseSeconds phases = take_phases();
    ASSERT_EQ(phases.size(), 1U);
    EXPECT_EQ(phases[0].first, "its");
  });
  other.join();
  const PhaseSeconds phases = take_phases();
  ASSERT_EQ(phases.size(), 1U);
  EXPECT_EQ(phases[0].first, "mine");
}

TEST(TimedPhase, IsAddedByName) {
  PhaseSeconds sum = {{"factor", 1.0}};
  add_phases({{"order", 0.5}, {"factor", 2.0}}, sum);
  EXPECT_EQ(sum, (PhaseSeconds{{"factor", 3.0}, {"order", 0.5}}));
}

}  // namespace
}  // namespace buckens::base
