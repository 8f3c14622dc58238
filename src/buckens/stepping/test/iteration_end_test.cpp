// SPDX-License-Identifier: Apache-2.0
// Where short links are far away, rounding of positions turns them far.
#include "buckens/stepping/iteration_end.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/dynamics/model_scales.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/stepper.h"

namespace buckens::stepping {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kShortLinks = 12;
constexpr double kShort = 0.01;  // [m] of a link
constexpr double kLong = 1000;   // of the rod that they hang on

/// Short links at the end of a rod 1 km long on a hinge, the last one heavy.
model::Model links_on_a_long_rod() {
  test::Mechanism m;
  m.set_gravity({0, -9.81, 0});
  m.set_length(kLong + kShortLinks * kShort);
  int previous = test::add_rod(m, 100.0, kLong, {{kLong / 2, 0, 0}, Quaterniond::Identity()});
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, 0}),
              m.rigid_marker(previous, {-kLong / 2, 0, 0}), Vector3d::UnitZ());
  double half = kLong / 2;
  for (int k = 0; k < kShortLinks; ++k) {
    const int link = test::add_rod(m, k + 1 == kShortLinks ? 10.0 : 0.1, kShort,
                                   {{kLong + kShort * (k + 0.5), 0, 0}, Quaterniond::Identity()});
    m.add_joint(joints::JointType::revolute, m.rigid_marker(previous, {half, 0, 0}),
                m.rigid_marker(link, {-kShort / 2, 0, 0}),
                k % 2 == 0 ? Vector3d::UnitZ() : Vector3d::UnitY());
    half = kShort / 2;
    previous = link;
  }
  return m.take();
}

/// The end of an iteration in a model of 1 km with this shortest lever.
IterationEnd end_with(double lever) {
  IterationEnd out(StepSettings{}, 1000.0, lever);
  out.begin(1000.0);
  return out;
}

// As a chain of 10 000 links of 0.1 m had them in turn, for ever: 2e-11 rad of a link, whose hinges
// are known to 6e-14 m, and which is turned by a lever of 0.07 m.
constexpr IterationEnd::Change kBefore = {1.57e-8, 0.0759};
constexpr IterationEnd::Change kChange = {2.24e-8, 0.0759};

TEST(IterationEnd, LeavesToAnotherRoundWhatThatClosesAnyway) {
  const IterationEnd end = end_with(0.07);
  const double motion = 1e-2, near = 1e-7 * motion;
  // Falls by a hundred, to a hundredth of what may be left, and to twice as much.
  EXPECT_TRUE(end.is_near({near, motion}, 100 * near));
  EXPECT_FALSE(end.is_near({200 * near, motion}, 100 * 200 * near));
  EXPECT_FALSE(end.is_near({near, motion}, 1.1 * near)) << "it hardly falls";
  EXPECT_FALSE(end.is_near({near, motion}, 0.0)) << "nothing is known of how it falls";
  // What is left must not show in the coupling load that is formed with it.
  StepSettings exact;
  exact.outer_tolerance = 1e-10;
  EXPECT_FALSE(IterationEnd(exact, 1.0, 1.0).is_near({near, motion}, 100 * near));
}

TEST(IterationEnd, CountsWhatRoundingTurnsByAShortLever) {
  EXPECT_TRUE(end_with(0.07).is_settled(kChange, kBefore, 0.14));
}

TEST(IterationEnd, DoesNotCountItWhereNothingIsShort) {
  EXPECT_FALSE(end_with(1000).is_settled(kChange, kBefore, 0.14));
}

TEST(IterationEnd, DoesNotCountMoreThanRounding) {
  // 1e-14 · 1000 m · 1000 m/0.07 m = 1.4e-7 m.
  EXPECT_FALSE(end_with(0.07).is_settled({2e-7, 0.0759}, {1.9e-7, 0.0759}, 0.14));
}

TEST(IterationEnd, GoesOnWhileChangesFall) {
  EXPECT_FALSE(end_with(0.07).is_settled({2.24e-8, 0.0759}, {5e-7, 0.0759}, 0.14));
  EXPECT_FALSE(end_with(0.07).is_settled(kChange, {}, 0.14));
}

TEST(IterationEnd, ForeseesNothingBelowTheRoundingOfAChange) {
  // A heap of balls whose rows had gone astray and let go came back so: 2 m are left of 2e16 m.
  IterationEnd end = end_with(0.07);
  EXPECT_FALSE(end.is_settled({1.84e16, 2.04}, {7.74e80, 1.84e16}, 0.0));
  EXPECT_TRUE(end.is_settled({1e-13, 0.01}, {2.04, 0.01}, 0.0));
}

TEST(ModelScales, ShortestLeverIsThatOfTheShortestLink) {
  // (ρ² + z²)/z of a rod of the length a with ρ² = a²/12 and z = a/2 is 2a/3; the rods of the tests
  // have a hundredth of that inertia along them, which adds half of it to ρ².
  const double gyration = 1.005 * kShort * kShort / 12;
  const double arm = kShort / 2;
  EXPECT_NEAR(dynamics::shortest_lever(links_on_a_long_rod()), (gyration + arm * arm) / arm,
              1e-15);  // rounding
}

/// Steps of 0.1 ms.
void steps_of_short_links(bool side_by_side) {
  const model::Model model = links_on_a_long_rod();
  StepSettings settings;
  settings.step = 1e-4;
  settings.side_by_side = side_by_side;
  std::vector<int> rows(static_cast<std::size_t>(model.num_constraint_rows()));
  std::iota(rows.begin(), rows.end(), 0);
  Stepper stepper(model, settings, rows);
  model::State state = model::placed_state(model);
  for (int k = 0; k < 300; ++k) {
    const StepReport report = stepper.step(state);
    // Ten roundings of 1 km.
    ASSERT_LT(report.position_residual, 1e-12) << k;
  }
}

TEST(ShortLinksFarAway, StepSideBySide) { steps_of_short_links(true); }
TEST(ShortLinksFarAway, StepOneByOne) { steps_of_short_links(false); }

}  // namespace
}  // namespace buckens::stepping
