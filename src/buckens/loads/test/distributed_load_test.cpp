// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/distributed_load.h"

#include <gtest/gtest.h>

#include "buckens/loads/pressure_load.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::loads {
namespace {

using base::TimeLaw;
using Eigen::Vector3d;

spatial::MarkerMotion moving() { return test::MarkerPath::some(1).at(0.3); }

std::array<TimeLaw, 3> ramp() {
  return {TimeLaw::expression(base::Expression("2*t", {"t"}, {}, {})), TimeLaw::constant(-1),
          TimeLaw()};
}

TEST(DistributedLoad, IsAForceAtTheMeanPlace) {
  const spatial::MarkerMotion at = moving();
  const Action fixed = DistributedLoad(LoadAxes::fixed, ramp(), 0.5).evaluate(0.3, at, {});
  EXPECT_NEAR((fixed.on_first.force - Vector3d(0.3, -0.5, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(fixed.on_first.torque.norm(), 0);
  EXPECT_NEAR(fixed.active_power, fixed.on_first.force.dot(at.v), 1e-15);
  const DistributedLoad following(LoadAxes::following, ramp(), 0.5);
  EXPECT_NEAR(
      (following.evaluate(0.3, at, {}).on_first.force - at.R * Vector3d(0.3, -0.5, 0)).norm(), 0,
      1e-15);
  EXPECT_TRUE(following.follows());
  EXPECT_TRUE(following.is_applied());
  EXPECT_FALSE(following.is_constant());
  EXPECT_NEAR((following.values(0.3) - Vector3d(0.6, -1, 0)).norm(), 0, 1e-15);
}

TEST(PressureLoad, TurnsWithTheBodyAndWorksOnFrameAndPattern) {
  const spatial::MarkerMotion at = moving();
  const PressureLoad load(TimeLaw::constant(4), 0.5, {0.1, 0.2, -0.3}, {0.01, 0, 0.02});
  const Action action = load.evaluate(0, at, {});
  EXPECT_NEAR((action.on_first.force - at.R * Vector3d(0.4, 0.8, -1.2)).norm(), 0, 1e-15);
  EXPECT_NEAR((action.on_first.torque - at.R * Vector3d(0.04, 0, 0.08)).norm(), 0, 1e-15);
  EXPECT_DOUBLE_EQ(action.along_pattern, 2.0);
  EXPECT_NEAR(action.active_power,
              action.on_first.force.dot(at.v) + action.on_first.torque.dot(at.w), 1e-14);
  EXPECT_TRUE(load.is_constant());
  EXPECT_EQ(load.num_values(), 1);
  EXPECT_EQ(load.values(0)[0], 4);
}

}  // namespace
}  // namespace buckens::loads
