// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/recorder.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/results/test/recorded.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {
namespace {

using Eigen::Vector3d;
using model::test::Described;
using test::Recorded;

Described beam_and_block() {
  Described m;
  m.beam("rod", {0, 0, 0}, {2, 0, 0}, 2);
  m.rigid("block", 1, {0, 0, 0}, {1, 1, 1}).at.position = {2, 0, 0};
  m.joint<joints::SphericalSpec>("ball", "rod/end", "block");
  m.joint<joints::BushingSpec>("mount", "ground", "rod/start").stiffness = {1, 1, 1};
  m.sensor_of<model::VelocitySensor>("tip", "rod/end");
  m.sensor<model::EnergySensor>("energy").kind = model::EnergyKind::total;
  return m;
}

TEST(Recorder, LaysOutChannelsWithUnits) {
  const Recorded run(beam_and_block());
  const RecordLayout& layout = run.recorder.layout();
  const auto expect = [&](const char* path, const char* unit, const std::vector<int>& shape) {
    const int index = layout.find(path);
    ASSERT_GE(index, 0) << path;
    const Channel& channel = layout.channel(static_cast<std::size_t>(index));
    EXPECT_EQ(channel.unit, unit) << path;
    EXPECT_EQ(channel.shape, shape) << path;
    EXPECT_FALSE(channel.description.empty()) << path;
  };
  expect("bodies/rod/pose", "m, 1", {7});
  expect("bodies/rod/velocity", "m/s", {3});
  expect("bodies/rod/angular_velocity", "rad/s", {3});
  expect("bodies/rod/displacement", "m, rad", {3, 6});
  expect("bodies/rod/section_force", "N, N m", {2, 12});
  expect("bodies/rod/stress", "Pa", {2, 2});
  expect("bodies/block/pose", "m, 1", {7});
  expect("joints/ball/force", "N", {3});
  expect("joints/ball/torque", "N m", {3});
  expect("energies/balance", "J", {});
  expect("sensors/tip", "m/s", {3});
  expect("sensors/energy", "J", {});
  EXPECT_EQ(layout.find("bodies/block/displacement"), -1);
  EXPECT_EQ(layout.find("joints/mount/force"), -1);
}

/// Points on the ground, the first one on a ball joint.
Described points(int count) {
  Described m;
  for (int k = 0; k < count; ++k) {
    m.rigid("p" + std::to_string(k), 1, {0, 0, 0}, {1, 1, 1}).at.position = {1.0 * k, 0, 0};
  }
  m.joint<joints::SphericalSpec>("ball", "ground", "p0");
  return m;
}

TEST(Recorder, PutsManyBodiesIntoOneTable) {
  constexpr int kMany = 3000;  // and a joint
  Recorded run(points(kMany));
  const RecordLayout& layout = run.recorder.layout();
  EXPECT_EQ(layout.find("bodies/p0/pose"), -1);
  EXPECT_EQ(layout.find("joints/ball/force"), -1);
  const int motions = layout.find("motions");
  ASSERT_GE(motions, 0);
  EXPECT_EQ(layout.channel(static_cast<std::size_t>(motions)).shape, (std::vector<int>{kMany, 13}));

  constexpr int kOne = 17;
  run.body(kOne).frame.X_WB = {Vector3d(1, 2, 3), spatial::exp_rotation({0, 0, 0.4})};
  run.body(kOne).frame.v = {4, 5, 6};
  run.body(kOne).frame.w = {7, 8, 9};
  run.state.lambda.tail<3>() = Vector3d(10, 11, 12);
  run.record();
  ASSERT_EQ(run.last.values.size(), layout.num_values());
  const Eigen::VectorXd row = run.values("motions").segment<13>(13 * kOne);
  EXPECT_EQ(row.head<3>(), Vector3d(1, 2, 3));
  EXPECT_NEAR(row[3], std::cos(0.2), 1e-15);  // w first
  EXPECT_EQ(row.segment<3>(7), Vector3d(4, 5, 6));
  EXPECT_EQ(row.tail<3>(), Vector3d(7, 8, 9));
  // The joint holds two markers at the origin together: what λ is along the world's axes.
  EXPECT_NEAR(run.values("reactions").head<3>().norm(), Vector3d(10, 11, 12).norm(), 1e-12);
}

TEST(Recorder, GivesFewBodiesChannelsOfTheirOwn) {
  const Recorded run(points(3));
  EXPECT_GE(run.recorder.layout().find("bodies/p2/pose"), 0);
  EXPECT_EQ(run.recorder.layout().find("motions"), -1);
}

TEST(Recorder, RecordsTheState) {
  Recorded run(beam_and_block());
  run.state.t = 0.25;
  run.body().frame.X_WB = {Vector3d(1, 2, 3), spatial::exp_rotation({0, 0, 0.4})};
  run.body().frame.v = {4, 5, 6};
  run.body().frame.w = {7, 8, 9};
  for (Eigen::Index k = 0; k < 18; ++k) run.body().d.change()[k] = 1e-3 * static_cast<double>(k);
  run.record();
  EXPECT_EQ(run.last.t, 0.25);
  EXPECT_EQ(run.last.values.size(), run.recorder.layout().num_values());
  const Eigen::VectorXd pose = run.values("bodies/rod/pose");
  EXPECT_EQ(pose.head<3>(), Vector3d(1, 2, 3));
  EXPECT_NEAR(pose[3], std::cos(0.2), 1e-15);  // w first
  EXPECT_NEAR(pose[6], std::sin(0.2), 1e-15);
  EXPECT_EQ(run.values("bodies/rod/velocity"), Vector3d(4, 5, 6));
  EXPECT_EQ(run.values("bodies/rod/angular_velocity"), Vector3d(7, 8, 9));
  // Node by node, six values each.
  const Eigen::VectorXd u = run.values("bodies/rod/displacement");
  const fem::FeModel& fe = run.built->model.bodies[0].flexible->fe;
  for (std::size_t n = 0; n < 3; ++n) {
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(u[static_cast<Eigen::Index>(6 * n + k)], run.body().d[fe.dofs.node_dofs[n][k]]);
    }
  }
}

TEST(Recorder, PlanarBodiesRecordZerosOutOfThePlane) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.beam("rod", {0, 0, 0}, {2, 0, 0}, 2);
  Recorded run(m);
  run.body().d.change().setConstant(1e-3);
  run.record();
  const Eigen::VectorXd u = run.values("bodies/rod/displacement");
  ASSERT_EQ(u.size(), 18);
  for (Eigen::Index n = 0; n < 3; ++n) {
    const Eigen::VectorXd node = u.segment<6>(6 * n);
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 1, 1, 0, 0, 0, 1).finished() * 1e-3;
    EXPECT_EQ(node, expected);
  }
}

TEST(Recorder, GeometryShowsBodiesAndConnections) {
  Described m = beam_and_block();
  m.d.gravity = {0, 0, -9.81};
  const Recorded run(m);
  const Geometry geometry = run.recorder.geometry();
  ASSERT_EQ(geometry.bodies.size(), 2U);
  EXPECT_EQ(geometry.bodies[0].kind, BodyKind::beam);
  ASSERT_EQ(geometry.bodies[0].nodes.rows(), 3);
  // Body frame: from the mass centre in the middle.
  EXPECT_NEAR((geometry.bodies[0].nodes.row(0).transpose() - Vector3d(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(geometry.bodies[0].elements.size(), 2U);
  EXPECT_EQ(geometry.bodies[0].radius.size(), 2U);
  for (const double radius : geometry.bodies[0].radius[0]) EXPECT_GT(radius, 0.0);
  ASSERT_EQ(geometry.bodies[0].sections.size(), 1U);  // once for both elements
  EXPECT_FALSE(geometry.bodies[0].sections[0].empty());
  EXPECT_EQ(geometry.bodies[0].element_sections, (std::vector<std::array<int, 2>>{{0, 0}, {0, 0}}));
  // A beam along x without `up` has z upwards.
  ASSERT_EQ(geometry.bodies[0].element_y.size(), 2U);
  EXPECT_NEAR((geometry.bodies[0].element_y[1] - Vector3d::UnitY()).norm(), 0, 1e-15);
  EXPECT_EQ(geometry.bodies[1].kind, BodyKind::rigid);
  EXPECT_EQ(geometry.bodies[1].nodes.rows(), 0);
  ASSERT_EQ(geometry.joints.size(), 2U);
  EXPECT_EQ(geometry.joints[0].type, "spherical");
  EXPECT_EQ(geometry.joints[0].between[0].body, 0);
  EXPECT_EQ(geometry.joints[0].between[1].body, 1);
  EXPECT_EQ(geometry.joints[1].type, "bushing");
  EXPECT_EQ(geometry.joints[1].between[0].body, kGroundBody);
  EXPECT_EQ(geometry.gravity, Vector3d(0, 0, -9.81));
  EXPECT_EQ(geometry.planar, "");
}

}  // namespace
}  // namespace buckens::results
