// SPDX-License-Identifier: Apache-2.0
// Parameters of springs, friction and motors that follow time and signals.
#include "buckens/loads/spring_laws.h"

#include <vector>

#include <gtest/gtest.h>

#include "buckens/loads/coordinate_motor.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/loads/spring_damper.h"

namespace buckens::loads {
namespace {

using base::SignalLaw;
using Eigen::Vector3d;

/// t and two signals.
const std::vector<double> kSignals = {0.5, 3.0, -2.0};

SignalLaw first() { return SignalLaw::of("a", 0); }
SignalLaw second() { return SignalLaw::of("b", 1); }

Sight seen(const spatial::MarkerMotion& at) {
  Sight out{0.5, at, at};
  out.signals = kSignals;
  return out;
}

TEST(SpringLaws, AreNumbersOrFollowSignals) {
  const SpringLaws numbers(4.0, 2.0, -1.0);
  EXPECT_TRUE(numbers.is_constant());
  EXPECT_FALSE(numbers.uses_signals() || numbers.drives_energy());
  EXPECT_EQ(numbers.at(7.0, {}).free, -1.0);

  const SpringLaws damper(4.0, first(), -1.0);
  EXPECT_TRUE(damper.uses_signals());
  EXPECT_FALSE(damper.is_constant());
  EXPECT_FALSE(damper.drives_energy());  // a damper stores nothing
  EXPECT_EQ(damper.at(0.5, kSignals).damping, 3.0);

  const SpringLaws driven(second(), second(), second());
  EXPECT_TRUE(driven.drives_energy());
  const SpringNumbers now = driven.at(0.5, kSignals);
  EXPECT_EQ(now.stiffness, 0.0);  // below zero
  EXPECT_EQ(now.damping, 0.0);
  EXPECT_EQ(now.free, -2.0);
}

TEST(SpringLaws, MakeTheForceOfASpringDamper) {
  const SpringDamper spring(first(), 5.0, 0.25, second());
  spatial::MarkerMotion F, M;
  M.p = Vector3d(1.0, 0, 0);
  M.v = Vector3d(0.1, 0, 0);
  Sight sight{0.5, F, M};
  sight.signals = kSignals;
  const Action action = spring.respond(sight);
  // 3 (1 − 0.25) + 5 · 0.1 − 2; rounding.
  EXPECT_NEAR(action.on_first.force.x(), 0.75, 1e-15);
  EXPECT_NEAR(action.stored_energy, 0.5 * 3 * 0.75 * 0.75, 1e-15);
  EXPECT_NEAR(action.dissipation, 0.05, 1e-15);
  std::vector<SoftRow> rows;
  spring.append_tangent(sight, rows);
  EXPECT_EQ(rows.at(0).stiffness, 3.0);
  EXPECT_EQ(rows.at(0).damping, 5.0);
  EXPECT_TRUE(spring.uses_signals() && spring.has_driven_energy() && !spring.is_constant());
}

TEST(FrictionLaws, SlidingNeverResistsMoreThanSticking) {
  FrictionData data;
  data.radius = 1.0;
  data.slip = 1e-3;
  const DrivenBound bound(data, Vector3d::UnitZ(), FrictionLaws{0.5, first(), 1.0, second()});
  spatial::MarkerMotion at;
  const FrictionBound now = bound.at(seen(at));
  EXPECT_EQ(now.data().static_coefficient, 0.5);
  EXPECT_EQ(now.data().dynamic_coefficient, 0.5);
  EXPECT_EQ(now.data().preload, 0.0);  // below zero
  EXPECT_TRUE(bound.uses_signals() && !bound.is_constant());
  const DrivenBound plain(data, Vector3d::UnitZ(), FrictionLaws{0.5, 0.4, 1.0, 2.0});
  EXPECT_TRUE(plain.is_constant());
  EXPECT_EQ(plain.at(seen(at)).at(10.0, 0.0), 0.5 * 10 + 2);  // at rest
}

TEST(MotorLimits, FollowSignals) {
  MotorData data;
  data.force = SignalLaw(9.0);
  data.limit = first();
  const CoordinateMotor motor(data);
  spatial::MarkerMotion at;
  EXPECT_TRUE(motor.uses_signals());
  EXPECT_EQ(motor.respond(seen(at)).along_coordinate, 3.0);
  data.limit = second();
  EXPECT_EQ(CoordinateMotor(data).respond(seen(at)).along_coordinate, 0.0);  // below zero
}

}  // namespace
}  // namespace buckens::loads
