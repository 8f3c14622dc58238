// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/sensor.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/results/test/recorded.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {
namespace {

using Eigen::Vector3d;
using model::test::at_marker;
using model::test::Described;
using test::Recorded;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Rounding of a few products of numbers up to 100.
constexpr double kRounding = 1e-12;

void expect_near(const Eigen::VectorXd& found, const Vector3d& expected, const char* what,
                 double tolerance = kRounding) {
  ASSERT_EQ(found.size(), 3) << what;
  EXPECT_NEAR((found - expected).norm(), 0, tolerance) << what << ": " << found.transpose();
}

/// A block with a marker at (1, 0, 0) from its mass centre, all marker sensors on it.
Described observed_block() {
  Described m;
  m.rigid("block", 2, {0, 0, 0}, {1, 2, 3}).markers = {Described::marker("p", {1, 0, 0})};
  const auto both = [&]<class Kind>(Kind*, const std::string& name) {
    m.sensor_of<Kind>(name, "block/p");
    m.sensor_of<Kind>(name + "_in_body", "block/p").in = at_marker("block");
  };
  both(static_cast<model::PositionSensor*>(nullptr), "position");
  both(static_cast<model::DisplacementSensor*>(nullptr), "displacement");
  both(static_cast<model::VelocitySensor*>(nullptr), "velocity");
  both(static_cast<model::AccelerationSensor*>(nullptr), "acceleration");
  both(static_cast<model::RotationSensor*>(nullptr), "rotation");
  both(static_cast<model::AngularVelocitySensor*>(nullptr), "spin");
  return m;
}

TEST(Sensors, FollowAMarkerInFreeFlight) {
  Recorded run(observed_block());
  run.record();
  expect_near(run.sensor("position"), {1, 0, 0}, "position");
  expect_near(run.sensor("displacement"), {0, 0, 0}, "displacement");
  expect_near(run.sensor("rotation"), {0, 0, 0}, "rotation");

  // Turned by 90° about z, spinning about z with 5 rad/s, flying along z, falling along −y.
  run.state.t = 1;
  run.body().frame.X_WB.p = {10, 20, 30};
  run.body().frame.X_WB.q = spatial::exp_rotation({0, 0, std::numbers::pi / 2});
  run.body().frame.v = {0, 0, 7};
  run.body().frame.w = {0, 0, 5};
  run.body().v_dot = {0, -9.81, 0};
  run.record();
  expect_near(run.sensor("position"), {10, 21, 30}, "position");
  expect_near(run.sensor("displacement"), {9, 21, 30}, "displacement");
  expect_near(run.sensor("velocity"), {-5, 0, 7}, "velocity: v + w × r");
  expect_near(run.sensor("acceleration"), {0, -9.81 - 25, 0}, "acceleration: g − w² r");
  expect_near(run.sensor("rotation"), {0, 0, std::numbers::pi / 2}, "rotation");
  expect_near(run.sensor("spin"), {0, 0, 5}, "angular velocity");
  // Body x is world y, body y is world −x.
  expect_near(run.sensor("position_in_body"), {21, -10, 30}, "position");
  expect_near(run.sensor("displacement_in_body"), {21, -9, 30}, "displacement");
  expect_near(run.sensor("velocity_in_body"), {0, 5, 7}, "velocity");
  expect_near(run.sensor("acceleration_in_body"), {-9.81 - 25, 0, 0}, "acceleration");
  expect_near(run.sensor("rotation_in_body"), {0, 0, std::numbers::pi / 2}, "rotation");
}

TEST(Sensors, AccelerationHasTheEulerTerm) {
  Recorded run(observed_block());
  run.body().w_dot = {0, 4, 3};
  run.record();
  expect_near(run.sensor("acceleration"), {0, 3, -4}, "ẇ × r");
}

TEST(Sensors, AngularVelocityIsGivenInWorldAxes) {
  Recorded run(observed_block());
  run.body().frame.X_WB.q = spatial::exp_rotation({std::numbers::pi / 2, 0, 0});
  run.body().frame.w = {0, 2, 0};  // body y, which is world z
  run.record();
  expect_near(run.sensor("spin"), {0, 0, 2}, "world axes");
  expect_near(run.sensor("spin_in_body"), {0, 2, 0}, "body axes");
}

TEST(Sensors, RotationIsThatSinceTheStart) {
  Described m = observed_block();
  m.d.bodies[0].at.orientation.emplace();
  m.d.bodies[0].at.orientation->axis = Vector3d::UnitX();
  m.d.bodies[0].at.orientation->angle = 0.7;
  Recorded run(m);
  run.record();
  expect_near(run.sensor("rotation"), {0, 0, 0}, "as placed");
  const Vector3d turn(0.3, -0.2, 0.5);
  run.body().frame.X_WB.q = spatial::exp_rotation(turn) * run.body().frame.X_WB.q;
  run.record();
  expect_near(run.sensor("rotation"), turn, "turned about world axes");
}

/// Relative sensors between the ground, or another body, and a block.
template <class Set>
Described relative(const std::string& first, model::RelativeQuantity quantity, Set set) {
  Described m;
  m.rigid("first", 1, {0, 0, 0}, {1, 1, 1});
  m.rigid("second", 1, {0, 0, 0}, {1, 1, 1});
  auto& sensor = m.sensor<model::RelativeSensor>("r");
  sensor.between = {at_marker(first), at_marker("second")};
  sensor.quantity = quantity;
  set(sensor);
  return m;
}

Described relative(model::RelativeQuantity quantity) {
  return relative("first", quantity, [](model::RelativeSensor&) {});
}

/// Value where the first body is turned by 90° about z with 2 rad/s; the second at (0, 3, 4) with
/// its own motion.
Eigen::VectorXd seen_between_moving_bodies(model::RelativeQuantity quantity) {
  Recorded run(relative(quantity));
  run.body(0).frame.X_WB.q = spatial::exp_rotation({0, 0, std::numbers::pi / 2});
  run.body(0).frame.w = {0, 0, 2};
  run.body(0).frame.v = {1, 0, 0};
  run.body(1).frame.X_WB.p = {0, 3, 4};
  run.body(1).frame.X_WB.q = spatial::exp_rotation({0, 0, std::numbers::pi / 2 + 0.4});
  run.body(1).frame.w = {0, 0, 7};
  run.body(1).frame.v = {0, 0, 6};
  run.record();
  return run.sensor("r");
}

TEST(Sensors, SeeRelativeMotionFromTheFirstMarker) {
  using Q = model::RelativeQuantity;
  expect_near(seen_between_moving_bodies(Q::position), {3, 0, 4}, "position");
  EXPECT_NEAR(seen_between_moving_bodies(Q::distance)[0], 5, kRounding);
  // World: (0, 0, 6) − (1, 0, 0) − 2 z × (0, 3, 4) = (5, 0, 6); first body's x is world y.
  expect_near(seen_between_moving_bodies(Q::velocity), {0, -5, 6}, "velocity");
  expect_near(seen_between_moving_bodies(Q::rotation), {0, 0, 0.4}, "rotation");
  expect_near(seen_between_moving_bodies(Q::angular_velocity), {0, 0, 5}, "angular velocity");
}

TEST(Sensors, AngleCountsTurns) {
  for (const double w : {9.0, -9.0}) {
    Recorded run(relative("ground", model::RelativeQuantity::angle, [](model::RelativeSensor& s) {
      s.axis = {0, 0, 2};
    }));
    const double dt = 0.4;  // 3.6 rad from record to record, more than half a turn
    for (int k = 0; k < 12; ++k) {
      run.state.t = k * dt;
      run.body(1).frame.X_WB.q = spatial::exp_rotation({0, 0, w * run.state.t});
      run.body(1).frame.w = {0, 0, w};
      run.record();
      // Nearly seven turns in all; rounding of angles of about 40 rad.
      EXPECT_NEAR(run.sensor("r")[0], w * run.state.t, kRounding);
    }
  }
}

TEST(Sensors, AngleNeedsAnAxisInSpace) {
  const Described m =
      relative("ground", model::RelativeQuantity::angle, [](model::RelativeSensor&) {});
  EXPECT_THAT(
      [&] { Recorded run(m); },
      ThrowsMessage<InputError>(HasSubstr("sensors.r.relative.axis: the key \"axis\" is missing")));
}

TEST(Sensors, BushingShowsItsForce) {
  Described m;
  m.rigid("block", 1, {0, 0, 0}, {1, 1, 1});
  auto& mount = m.joint<joints::BushingSpec>("mount", "ground", "block");
  mount.stiffness = {1000, 2000, 3000};
  mount.damping = {10, 0, 0};
  mount.rotational_stiffness = {0, 0, 40};
  m.sensor<model::JointForceSensor>("force").joint = "mount";
  m.sensor<model::JointTorqueSensor>("torque").joint = "mount";
  Recorded run(m);
  run.body().frame.X_WB.p = {0.01, 0.02, 0};
  run.body().frame.v = {3, 0, 0};
  run.record();
  expect_near(run.sensor("force"), {-10 - 30, -40, 0}, "−K r − C ṙ");
  run.body().frame = {};
  run.body().frame.X_WB.q = spatial::exp_rotation({0, 0, 0.1});
  run.record();
  expect_near(run.sensor("torque"), {0, 0, -4}, "−K θ");
}

TEST(Sensors, JointForceComesFromTheMultipliers) {
  Described m;
  m.rigid("block", 1, {0, 0, 0}, {1, 1, 1});
  m.joint<joints::SphericalSpec>("ball", "ground", "block");
  m.sensor<model::JointForceSensor>("force").joint = "ball";
  m.sensor<model::JointForceSensor>("force_in_block").joint = "ball";
  std::get<model::JointForceSensor>(m.d.output.sensors[1].kind).in = at_marker("block");
  Recorded run(m);
  run.body().frame.X_WB.q = spatial::exp_rotation({0, 0, std::numbers::pi / 2});
  // g = p_M − p_F in world axes: λ is the force on the second marker.
  run.state.lambda = Vector3d(1, 2, 3);
  run.record();
  expect_near(run.sensor("force"), {1, 2, 3}, "world axes");
  expect_near(run.sensor("force_in_block"), {2, -1, 3}, "axes of the block");
  expect_near(run.values("joints/ball/force"), {1, 2, 3}, "channel");
  expect_near(run.values("joints/ball/torque"), {0, 0, 0}, "channel");
}

TEST(Sensors, UnknownJointsAreRefused) {
  Described m;
  m.rigid("block", 1, {0, 0, 0}, {1, 1, 1});
  m.joint<joints::SphericalSpec>("ball", "ground", "block");
  m.sensor<model::JointForceSensor>("force").joint = "bal";
  EXPECT_THAT([&] { Recorded run(m); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("test.yaml:70:1"), HasSubstr("\"bal\""), HasSubstr("\"ball\""))));
}

TEST(Sensors, EnergiesAddUp) {
  Described m;
  m.d.gravity = {0, 0, -10};
  m.rigid("block", 2, {0, 0, 0}, {1, 2, 3});
  using K = model::EnergyKind;
  const std::pair<const char*, K> kinds[] = {
      {"total", K::total},    {"kinetic", K::kinetic}, {"potential", K::potential},
      {"strain", K::strain},  {"work", K::work},       {"dissipated", K::dissipated},
      {"balance", K::balance}};
  for (const auto& [name, kind] : kinds) m.sensor<model::EnergySensor>(name).kind = kind;
  Recorded run(m);
  run.record();
  EXPECT_EQ(run.sensor("balance")[0], 0);
  run.body().frame.X_WB.p = {0, 0, 3};
  run.body().frame.v = {0, 0, 4};
  run.body().frame.w = {2, 0, 0};
  WorkBalance work;
  work.external = 70;
  work.dissipated = 5;
  run.record(work);
  EXPECT_NEAR(run.sensor("kinetic")[0], 0.5 * 2 * 16 + 0.5 * 1 * 4, kRounding);
  EXPECT_NEAR(run.sensor("potential")[0], 2 * 10 * 3, kRounding);
  EXPECT_NEAR(run.sensor("strain")[0], 0, kRounding);
  EXPECT_NEAR(run.sensor("total")[0], 18 + 60, kRounding);
  EXPECT_NEAR(run.sensor("work")[0], 70, kRounding);
  EXPECT_NEAR(run.sensor("dissipated")[0], 5, kRounding);
  EXPECT_NEAR(run.sensor("balance")[0], 78 - 70 + 5, kRounding);
  EXPECT_NEAR(run.recorder.last_balance(), 78 - 70 + 5, kRounding);
}

}  // namespace
}  // namespace buckens::results
