// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/spec/field_lines.h"

namespace buckens::model {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::ThrowsMessage;

ModelBuilder pendulum() {
  ModelBuilder m("pendulum");
  m.gravity({0, -9.81, 0}).planar(spatial::Plane::xy);
  m.add_rigid("rod", 2, {0.5, 0, 0}, {0, 0, 0.1});
  m.add_marker("rod", "pin", {0, 0, 0});
  m.add_joint("hinge", joints::RevoluteSpec(), ModelBuilder::ground({0, 1, 0}),
              ModelBuilder::marker("rod/pin"));
  m.add_force("push", "rod", {1, 0, 0});
  m.add_sensor("angle", RelativeSensor()).between = {ModelBuilder::marker("ground"),
                                                     ModelBuilder::marker("rod")};
  m.simulation(1, 1e-3);
  return m;
}

TEST(ModelBuilder, MakesTheModelThatAFileWouldMake) {
  ModelBuilder m = pendulum();
  const auto built = m.build();
  ASSERT_EQ(built->model.bodies.size(), 1U);
  EXPECT_EQ(built->model.bodies[0].mass, 2.0);
  EXPECT_EQ(built->model.num_constraint_rows(), 2);
  EXPECT_EQ(built->model.joints[0].first.X_WF.p, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(built->model.loads[0].unit, "N");
  EXPECT_THAT(field_lines(m.description()),
              testing::AllOf(Contains("bodies.rod.rigid.mass: 2"),
                             Contains("loads.push.force.value.0: 1, 1, 1, 1, 1, 1, 1"),
                             Contains("planar: xy")));
}

TEST(ModelBuilder, CanBeBuiltAgainAfterAChange) {
  ModelBuilder m = pendulum();
  const auto first = m.build();
  std::get<body::RigidSpec>(m.description().bodies[0].kind).mass = 3;
  EXPECT_EQ(m.build()->model.bodies[0].mass, 3.0);
  EXPECT_EQ(first->model.bodies[0].mass, 2.0);
}

TEST(ModelBuilder, RefusesNamesTwiceAndUnknownBodies) {
  ModelBuilder m = pendulum();
  EXPECT_THAT(
      [&] {
        m.add_rigid("rod", 1, {0, 0, 0}, {0, 0, 1});
      },
      ThrowsMessage<InputError>(HasSubstr("\"rod\" is taken")));
  EXPECT_THAT(
      [&] {
        m.add_rigid("", 1, {0, 0, 0}, {0, 0, 1});
      },
      ThrowsMessage<InputError>(HasSubstr("is empty")));
  EXPECT_THAT(
      [&] {
        m.add_marker("rot", "end", {1, 0, 0});
      },
      ThrowsMessage<InputError>(HasSubstr("Did you mean \"rod\"?")));
  EXPECT_THAT([&] { m.add_force_law("push", "rod", {}); },
              ThrowsMessage<InputError>(HasSubstr("\"push\" is taken")));
}

TEST(ModelBuilder, RefusesNamesThatAreGivenTwiceByRenaming) {
  ModelBuilder m = pendulum();
  body::BodySpec& other = m.add_rigid("other", 1, {0, 0, 0}, {0, 0, 1});
  other.name = "rod";
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(HasSubstr("\"rod\" is taken")));
  other.name = "third";
  m.add_marker("third", "end", {1, 0, 0});
  EXPECT_EQ(m.description().bodies.back().markers.size(), 1U);
  // A name that is no longer used is free.
  m.description().bodies.pop_back();
  m.add_rigid("third", 1, {0, 0, 0}, {0, 0, 1});
  EXPECT_EQ(m.description().bodies.size(), 2U);
}

TEST(ModelBuilder, AnOwnForceActsOnItsMarker) {
  ModelBuilder m = pendulum();
  m.add_force_law("drag", "rod/pin", [](double t, const spatial::MarkerMotion& marker) {
    return Eigen::Vector3d(t, -2.0 * marker.v.y(), 0);
  });
  const auto built = m.build();
  ASSERT_EQ(built->model.loads.size(), 2U);
  const Load& drag = built->model.loads[1];
  EXPECT_EQ(drag.name, "drag");
  spatial::MarkerMotion motion;
  motion.v = {0, 3, 0};
  const loads::Action action = drag.element->evaluate(0.5, motion, {});
  EXPECT_EQ(action.on_first.force, Eigen::Vector3d(0.5, -6, 0));
  EXPECT_EQ(action.active_power, -18.0);
}

TEST(ModelBuilder, AnOwnForceWithoutLawIsRefused) {
  ModelBuilder m = pendulum();
  m.add_force_element("drag", nullptr, "rod/pin");
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(HasSubstr("no force law")));
}

}  // namespace
}  // namespace buckens::model
