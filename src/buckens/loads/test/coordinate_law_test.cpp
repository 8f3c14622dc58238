// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/coordinate_law.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/loads/end_of_set.h"
#include "buckens/loads/joint_friction.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;

/// A sled on the x axis of the ground.
struct Sled {
  spatial::MarkerMotion ground, body;
  double state = 0;

  Sight at(double x, double rate, double change = 0) {
    body.p.x() = x;
    body.v.x() = rate;
    Sight sight{0.0, ground, body, {}, {}, &state};
    sight.coordinate.value = x;
    sight.coordinate.rate = rate;
    sight.coordinate.change = change;
    sight.coordinate.J[3] = -1;
    sight.coordinate.J[9] = 1;
    return sight;
  }
};

double stiffness(const ForceElement& law, const Sight& sight) {
  std::vector<SoftRow> rows;
  law.append_tangent(sight, rows);
  EXPECT_EQ(rows.size(), 1U);
  return rows.at(0).stiffness;
}

TEST(EndOfSet, TellsEndsOfAnySlope) {
  for (const double slope : {0.0, 1e-320, 1.0, 1e308, HUGE_VAL}) {
    EXPECT_EQ(EndOfSet::of(EndOfSet::regime(2.0, slope)), 1) << slope;
    EXPECT_EQ(EndOfSet::of(EndOfSet::regime(-2.0, slope)), -1) << slope;
  }
  EXPECT_EQ(EndOfSet::of(0), 0);
  EXPECT_EQ(EndOfSet::of(-2), 0);
}

TEST(CoordinateLaw, SpringActsOnBothMarkersAgainstItsStrain) {
  Sled sled;
  const CoordinateSpring spring(200, 3, 0.1);
  const Action action = spring.respond(sled.at(0.4, 0.5));
  EXPECT_DOUBLE_EQ(action.along_coordinate, -200 * 0.3 - 3 * 0.5);
  EXPECT_DOUBLE_EQ(action.on_second.force.x(), action.along_coordinate);
  EXPECT_DOUBLE_EQ(action.on_first.force.x(), -action.along_coordinate);
  EXPECT_DOUBLE_EQ(action.stored_energy, 100 * 0.09);
  EXPECT_DOUBLE_EQ(action.dissipation, 3 * 0.25);
  EXPECT_DOUBLE_EQ(stiffness(spring, sled.at(0.4, 0.5)), 200);
}

TEST(CoordinateLaw, StopPushesBeyondItsEndsAndNeverPulls) {
  Sled sled;
  const CoordinateStop stop(-0.1, 0.2, 1000, 50);
  EXPECT_EQ(stop.respond(sled.at(0.15, 3)).along_coordinate, 0);
  EXPECT_EQ(stiffness(stop, sled.at(0.15, 3)), 0);
  EXPECT_NEAR(stop.respond(sled.at(0.21, 0.1)).along_coordinate, -15, 1e-12);
  EXPECT_NEAR(stop.respond(sled.at(-0.13, -0.1)).along_coordinate, 35, 1e-12);
  EXPECT_EQ(stiffness(stop, sled.at(-0.13, -0.1)), 1000);
  // Its damper would pull: it releases, and the energy of its spring is lost.
  const Action released = stop.respond(sled.at(0.21, -1));
  EXPECT_EQ(released.along_coordinate, 0);
  EXPECT_NEAR(released.dissipation, 1000 * 0.01 * 1, 1e-12);
  EXPECT_EQ(stiffness(stop, sled.at(0.21, -1)), 0);
  EXPECT_NE(released.regime, stop.respond(sled.at(0.21, 0.1)).regime);
}

TEST(CoordinateLaw, StopSetsInWithoutAJumpAtAnySpeed) {
  // A damper that acted at once would push with 50 N at 1 m/s: no step could end near 0.2.
  Sled sled;
  const CoordinateStop stop(-0.1, 0.2, 1000, 50);
  EXPECT_NEAR(stop.respond(sled.at(0.2 + 1e-9, 1)).along_coordinate, -2e-6, 1e-12);
  EXPECT_NEAR(stop.respond(sled.at(0.21, 1)).along_coordinate, -20, 1e-12);
  EXPECT_DOUBLE_EQ(stop.respond(sled.at(0.21, 1)).dissipation, 1000 * (0.21 - 0.2) * 1);
  EXPECT_DOUBLE_EQ(stiffness(stop, sled.at(0.21, 1)), 2000);
}

TEST(CoordinateLaw, PowerIsWhatIsStoredAndLost) {
  Sled sled;
  const CoordinateSpring spring(200, 3, 0.1);
  const CoordinateStop stop(-0.1, 0.2, 1000, 50);
  for (const ForceElement* law :
       {static_cast<const ForceElement*>(&spring), static_cast<const ForceElement*>(&stop)}) {
    for (const double rate : {-2.0, -0.1, 0.3}) {
      const double x = 0.25, dt = 1e-6;
      const Action action = law->respond(sled.at(x, rate));
      const double stored = (law->respond(sled.at(x + rate * dt, rate)).stored_energy -
                             law->respond(sled.at(x - rate * dt, rate)).stored_energy) /
                            (2 * dt);
      // Stored energies are quadratic: their central difference is exact but for rounding.
      EXPECT_NEAR(action.along_coordinate * rate + stored, -action.dissipation, 1e-7);
      EXPECT_GE(action.dissipation, 0);
    }
  }
}

FrictionData pin() {
  FrictionData data;
  data.static_coefficient = data.dynamic_coefficient = 0.3;
  data.preload = 2;
  data.slip = 1e-3;
  data.radius = 1;
  return data;
}

TEST(JointFriction, SticksElasticallyAndSlidesByItsBound) {
  const JointFriction friction(pin(), Vector3d::UnitX());
  Sled sled;
  auto sight = sled.at(0, 0, 4e-4);
  sight.reaction.force = Vector3d(99, 6, 8);  // along the way it does not press
  const double bound = 0.3 * 10 + 2;
  EXPECT_DOUBLE_EQ(friction.load(sight), 10);
  EXPECT_DOUBLE_EQ(friction.respond(sight).along_coordinate, -0.4 * bound);
  EXPECT_DOUBLE_EQ(stiffness(friction, sight), bound / 1e-3);
  double next = 0;
  friction.find_states(sight, &next);
  EXPECT_DOUBLE_EQ(next, 4e-4);
  // Beyond its slip it slides, and its spring stays bent by the slip.
  sight.coordinate.change = 0.7;
  sight.coordinate.rate = 5;
  const Action sliding = friction.respond(sight);
  EXPECT_DOUBLE_EQ(sliding.along_coordinate, -bound);
  EXPECT_DOUBLE_EQ(sliding.dissipation, bound * 5);
  EXPECT_EQ(stiffness(friction, sight), 0);
  friction.find_states(sight, &next);
  EXPECT_DOUBLE_EQ(next, 1e-3);
  // On reversal it is elastic at first.
  sled.state = next;
  sight.coordinate.change = -5e-4;
  sight.coordinate.rate = 0;
  EXPECT_NEAR(friction.respond(sight).along_coordinate, -0.5 * bound, 1e-12);
}

TEST(JointFriction, AnswersAtLessCostWhereItSlidesOn) {
  FrictionData data = pin();
  data.stribeck_rate = 0.1;
  data.viscous = 0.1;
  data.inertia = 0.5;
  // The last slides without a bound: from 30 Stribeck rates on, its coefficient is zero.
  for (const auto& [static_coefficient, dynamic, preload] :
       {std::array{0.2, 0.2, 2.0}, std::array{0.3, 0.2, 2.0}, std::array{0.3, 0.0, 0.0}}) {
    data.static_coefficient = static_coefficient;
    data.dynamic_coefficient = dynamic;
    data.preload = preload;
    const JointFriction friction(data, Vector3d::UnitX());
    Sled sled;
    for (const double change : {-3e-3, -1.1e-3, -4e-4, 0.0, 9e-4, 1.3e-3, 0.2}) {
      for (const double rate : {-5.0, -0.2, 0.0, 0.1, 3.0}) {
        auto sight = sled.at(0, rate, change);
        sight.reaction.force = Vector3d(0, 6, 8);
        const CoordinateResponse general = friction.CoordinateLaw::answer(sight);
        const CoordinateResponse response = friction.answer(sight);
        EXPECT_DOUBLE_EQ(response.force, general.force) << change << " " << rate;
        EXPECT_DOUBLE_EQ(response.strain, general.strain) << change << " " << rate;
        EXPECT_DOUBLE_EQ(response.stored_energy, general.stored_energy);
        EXPECT_DOUBLE_EQ(response.active_power, general.active_power);
        EXPECT_DOUBLE_EQ(response.dissipation, general.dissipation);
        EXPECT_EQ(response.regime, general.regime) << change << " " << rate;
      }
    }
  }
}

TEST(JointFriction, WithoutItsSetItWouldStick) {
  FrictionData data = pin();
  data.inertia = 0.5;
  data.viscous = 0.1;
  const JointFriction friction(data, Vector3d::UnitX());
  Sled sled;
  for (const double change : {4e-4, -7e-3}) {  // sticks, slides
    auto sight = sled.at(0, 0.2, change);
    sight.reaction.force = Vector3d(0, 6, 8);
    const double stiffness = (0.3 * 10 + 2) / 1e-3;
    const double damping = 2 * std::sqrt(stiffness * 0.5);
    const UnlimitedForce whole = friction.unlimited(sight);
    EXPECT_DOUBLE_EQ(whole.stiffness, stiffness);
    EXPECT_DOUBLE_EQ(whole.damping, damping + 0.1);
    EXPECT_NEAR(friction.respond(sight).along_coordinate + whole.excess,
                -stiffness * change - whole.damping * 0.2, 1e-12 * stiffness);
  }
  // A stop is not held: its damper is limited by its spring.
  const CoordinateStop stop(-0.1, 0.2, 1000, 50);
  EXPECT_EQ(stop.unlimited(sled.at(0.21, -1)).stiffness, 0);
}

TEST(JointFriction, SpringBreaksAwayWhereItsDamperMakesUpForTheStrain) {
  // Within a long step it has gone back by 50 slips and turned round: spring and damper alone are
  // 50 times the bound each and cancel out.
  FrictionData data = pin();
  data.inertia = 0.5;
  const JointFriction friction(data, Vector3d::UnitX());
  const double bound = 0.3 * 10 + 2, damping = 2 * std::sqrt(bound / 1e-3 * 0.5);
  Sled sled;
  auto sight = sled.at(0, 50.5 * bound / damping, -50e-3);
  sight.reaction.force = Vector3d(0, 6, 8);
  const Action action = friction.respond(sight);
  // 1e-11: rounding of 250 N.
  EXPECT_NEAR(action.along_coordinate, -0.5 * bound, 1e-11);
  // No more than a spring bent by its slip holds, and no more than the force takes.
  EXPECT_DOUBLE_EQ(action.stored_energy, 0.5 * bound * 1e-3);
  EXPECT_NEAR(action.dissipation, 0.5 * bound * sight.coordinate.rate, 1e-10);
  double next = 0;
  friction.find_states(sight, &next);
  EXPECT_DOUBLE_EQ(next, -1e-3);
}

TEST(JointFriction, WeighsForcesAndMomentsByTheirLevers) {
  FrictionData data;
  data.static_coefficient = 0.2;
  data.dynamic_coefficient = 0.1;
  data.stribeck_rate = 0.5;
  data.radius = 0.01;
  data.axial_radius = 0.03;
  data.bearing_length = 0.05;
  data.slip = 1e-5;
  const JointFriction friction(data, Vector3d::UnitZ());
  Sled sled;
  auto sight = sled.at(0, 0.5, 1);
  sight.reaction = {Vector3d(0, 2, 7), Vector3d(3, 4, -6)};
  const double load = 0.01 * 5 + 0.03 * 6 + 0.01 * 2 / 0.025;
  EXPECT_DOUBLE_EQ(friction.load(sight), load);
  const double mu = 0.1 + 0.1 * std::exp(-1.0);
  EXPECT_DOUBLE_EQ(friction.respond(sight).along_coordinate, -mu * load);
}

}  // namespace
}  // namespace buckens::loads
