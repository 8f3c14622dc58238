// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"
#include "buckens/model/test/described.h"

namespace buckens::model {
namespace {

using Eigen::Vector3d;
using test::Described;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

TEST(ModelBuilder, PlacesBodiesByTheirModelAxes) {
  Described m;
  body::BodySpec& spec = m.rigid("disk", 2, {0.5, 0, 0}, {1, 2, 3});
  spec.at.position = {1, 2, 3};
  spec.at.orientation.emplace();
  spec.at.orientation->axis = Vector3d::UnitZ();
  spec.at.orientation->angle = std::numbers::pi / 2;
  const auto built = m.build();
  const body::Body& body = built->model.bodies[0];
  EXPECT_EQ(body.mass, 2);
  EXPECT_EQ(body.J0.diagonal(), Vector3d(1, 2, 3));
  // Turned by 90° about z the mass centre lies along world y of the origin. Rounding only.
  EXPECT_NEAR((built->model.placed[0].p - Vector3d(1, 2.5, 3)).norm(), 0, 1e-15);
  EXPECT_EQ(body.rotation_basis.cols(), 3);
  EXPECT_EQ(body.translation_basis.cols(), 3);
  EXPECT_THAT(built->model.notes, testing::IsEmpty());
}

TEST(ModelBuilder, UnknownNamesAreRefusedWithTheNearest) {
  Described m;
  m.rigid("crank", 1, {0, 0, 0}, {1, 1, 1}).markers = {Described::marker("pin", {1, 0, 0})};
  m.joint<joints::SphericalSpec>("ball", "ground", "cranc/pin");
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(
                  AllOf(StartsWith("test.yaml:99:1"), HasSubstr("\"cranc\""), HasSubstr("crank"))));
  m.d.joints.clear();
  m.joint<joints::SphericalSpec>("ball", "ground", "crank/pim");
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(AllOf(
                                      HasSubstr("\"pim\""), HasSubstr("Did you mean \"pin\"?"))));
}

TEST(ModelBuilder, JointsAndSpringsNeedTwoBodies) {
  Described m;
  m.rigid("rod", 1, {0, 0, 0}, {1, 1, 1}).markers = {Described::marker("a", {1, 0, 0}),
                                                     Described::marker("b", {2, 0, 0})};
  m.joint<joints::SphericalSpec>("ball", "rod/a", "rod/b");
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(AllOf(StartsWith("test.yaml:50:1"),
                                              HasSubstr("joints.ball.spherical.between"),
                                              HasSubstr("on the same body"))));
  m.d.joints.clear();
  m.load<loads::SpringDamperSpec>("spring").between = {test::at_marker("ground"),
                                                       test::at_marker("ground")};
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(HasSubstr("the same marker")));
}

TEST(ModelBuilder, LoadsOnTheGroundAreRefused) {
  Described m;
  m.rigid("rod", 1, {0, 0, 0}, {1, 1, 1});
  m.force("push", "ground", {1, 0, 0});
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(HasSubstr("a load on the ground has no effect")));
}

TEST(ModelBuilder, AForceOnTheFrameOfAFlexibleBodyIsRefused) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 2);
  m.force("push", "rod", {1, 0, 0});
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(AllOf(StartsWith("test.yaml:99:1"), HasSubstr("\"rod\""),
                                              HasSubstr("start, end, mid"))));
  // A sensor may observe it.
  m.d.loads.clear();
  m.sensor_of<PositionSensor>("middle", "rod");
  EXPECT_NO_THROW(m.build());
}

TEST(ModelBuilder, BarsCarryNoMoment) {
  Described m;
  m.truss("truss", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}, {"c", {0, 1, 0}}},
          {{"a", "b"}, {"b", "c"}, {"c", "a"}});
  m.d.planar = spatial::Plane::xy;
  m.torque("twist", "truss/b", {0, 0, 1});
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(StartsWith("test.yaml:60:1"), HasSubstr("\"twist\""),
                                              HasSubstr("cannot carry a moment"))));
  m.d.loads.clear();
  m.joint<joints::FixedSpec>("weld", "ground", "truss/a");
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("\"weld\""), HasSubstr("moment"))));
  m.d.joints.clear();
  // A planar hinge and a force need no moment.
  m.joint<joints::RevoluteSpec>("hinge", "ground", "truss/a");
  m.force("push", "truss/b", {0, 1, 0});
  EXPECT_NO_THROW(m.build());
}

TEST(ModelBuilder, BarsInARowAreRefusedAsAMechanism) {
  const std::vector<std::pair<std::string, Vector3d>> nodes = {
      {"a", {0, 0, 0}}, {"b", {1, 0, 0}}, {"c", {2, 0, 0}}};
  for (const bool planar : {false, true}) {
    Described m;
    if (planar) m.d.planar = spatial::Plane::xy;
    m.truss("chain", nodes, {{"a", "b"}, {"b", "c"}});
    EXPECT_THAT([&] { m.build(); }, ThrowsMessage<ModelError>(
                                        AllOf(StartsWith("test.yaml:10:1"), HasSubstr("\"chain\""),
                                              HasSubstr("mechanism"), HasSubstr("node \""))))
        << (planar ? "planar" : "in space");
  }
  // One bar alone and a triangle in its plane are stiff; a triangle of bars in space, too.
  Described stiff;
  stiff.truss("bar", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}}, {{"a", "b"}});
  stiff.truss("triangle", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}, {"c", {0, 1, 0}}},
              {{"a", "b"}, {"b", "c"}, {"c", "a"}});
  EXPECT_NO_THROW(stiff.build());
}

TEST(ModelBuilder, ASquareOfBarsIsAMechanismUntilItIsBraced) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.truss("square", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}, {"c", {1, 1, 0}}, {"d", {0, 1, 0}}},
          {{"a", "b"}, {"b", "c"}, {"c", "d"}, {"d", "a"}});
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<ModelError>(HasSubstr("mechanism")));
  auto& structure = std::get<fem::StructureSpec>(m.d.bodies[0].kind);
  structure.bars.push_back(structure.bars[0]);
  structure.bars.back().between = {"a", "c"};
  EXPECT_NO_THROW(m.build());
}

TEST(ModelBuilder, PlanarModelsRefuseWhatLeavesThePlane) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.d.gravity = {0, -9.81, 0.1};
  m.rigid("rod", 1, {0, 0, 0}, {0, 0, 1});
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(HasSubstr("gravity")));

  m.d.gravity = {0, -9.81, 0};
  m.d.bodies[0].at.orientation.emplace();
  m.d.bodies[0].at.orientation->axis = Vector3d::UnitX();
  m.d.bodies[0].at.orientation->angle = 0.1;
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(AllOf(StartsWith("test.yaml:10:1"), HasSubstr("\"rod\""),
                                              HasSubstr("rotated out of the plane"))));

  m.d.bodies[0].at.orientation->axis = Vector3d::UnitZ();
  m.joint<joints::RevoluteSpec>("hinge", "ground", "rod").axis = Vector3d::UnitX();
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(StartsWith("test.yaml:50:1"), HasSubstr("\"hinge\""),
                                              HasSubstr("normal"))));
  // Without an axis the normal of the plane is meant: two rows hold the point.
  std::get<joints::RevoluteSpec>(m.d.joints[0].kind).axis.reset();
  const auto built = m.build();
  EXPECT_EQ(built->model.num_constraint_rows(), 2);
  EXPECT_EQ(built->model.bodies[0].rotation_basis.cols(), 1);
  EXPECT_EQ(built->model.bodies[0].translation_basis.cols(), 2);
}

TEST(ModelBuilder, PlanarModelsRefuseLoadsThatLeaveThePlane) {
  const auto with = [](bool moment, loads::LoadAxes axes, const Vector3d& value) {
    Described m;
    m.d.planar = spatial::Plane::xy;
    auto& rod = m.rigid("rod", 1, {0, 0, 0}, {0, 0, 1});
    rod.markers.push_back(Described::marker("tip", {1, 0, 0}));
    rod.markers[0].orientation.emplace();
    rod.markers[0].orientation->axis = Vector3d::UnitX();
    rod.markers[0].orientation->angle = M_PI / 4;  // y and z both half out of the plane
    if (moment) {
      m.torque("load", "rod/tip", value);
      std::get<loads::TorqueSpec>(m.d.loads[0].kind).axes = axes;
    } else {
      m.force("load", "rod/tip", value);
      std::get<loads::ForceSpec>(m.d.loads[0].kind).axes = axes;
    }
    return m;
  };
  using loads::LoadAxes;
  const auto refused = [](const char* component) {
    return ThrowsMessage<InputError>(AllOf(StartsWith("test.yaml:60:1"), HasSubstr("\"load\""),
                                           HasSubstr("in a planar model"), HasSubstr(component)));
  };
  EXPECT_THAT([&] { with(false, LoadAxes::fixed, {1, 2, 5}).build(); }, refused("component z"));
  EXPECT_THAT([&] { with(false, LoadAxes::following, {1, 2, 0}).build(); }, refused("component y"));
  EXPECT_THAT([&] { with(true, LoadAxes::following, {3, 0, 0}).build(); }, refused("component x"));
  EXPECT_THAT([&] { with(true, LoadAxes::following, {0, 0, 3}).build(); }, refused("component z"));
  EXPECT_NO_THROW(with(false, LoadAxes::fixed, {1, 2, 0}).build());
  EXPECT_NO_THROW(with(false, LoadAxes::following, {1, 2, -2}).build()) << "along y of the world";
  EXPECT_NO_THROW(with(true, LoadAxes::following, {0, 2, 2}).build()) << "about the normal";
  // A time function is not added to others.
  Described m = with(false, LoadAxes::following, {1, 0, 0});
  std::get<loads::ForceSpec>(m.d.loads[0].kind).value[1] =
      base::TimeLaw::expression(base::Expression("t", {"t"}, {}, {}));
  EXPECT_THAT([&] { m.build(); }, refused("component y"));
}

TEST(ModelBuilder, PlanarTorsionalSpringsTurnAboutTheNormal) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.rigid("rod", 1, {0, 0, 0}, {0, 0, 1});
  auto& spring = m.load<loads::TorsionalSpringSpec>("coil");
  spring.between = {test::at_marker("ground"), test::at_marker("rod")};
  spring.axis = Vector3d::UnitX();
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(AllOf(StartsWith("test.yaml:60:1"), HasSubstr("\"coil\""),
                                              HasSubstr("normal to the plane"))));
  std::get<loads::TorsionalSpringSpec>(m.d.loads[0].kind).axis = -Vector3d::UnitZ();
  EXPECT_NO_THROW(m.build());
}

TEST(ModelBuilder, AxesMustBeGivenInSpace) {
  Described m;
  m.rigid("rod", 1, {0, 0, 0}, {1, 1, 1});
  m.joint<joints::RevoluteSpec>("hinge", "ground", "rod");
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(HasSubstr(
                                      "joints.hinge.revolute.axis: the key \"axis\" is missing")));
}

TEST(ModelBuilder, PointMassesDropTheirRotations) {
  Described m;
  m.rigid("ball", 1, {0, 0, 0}, {0, 0, 0});
  m.rigid("needle", 1, {0, 0, 0}, {0, 1, 1});
  const auto built = m.build();
  EXPECT_EQ(built->model.bodies[0].rotation_basis.cols(), 0);
  ASSERT_EQ(built->model.bodies[1].rotation_basis.cols(), 2);
  EXPECT_NEAR(built->model.bodies[1].rotation_basis.row(0).norm(), 0, 1e-15);
  // One note per axis.
  ASSERT_EQ(built->model.notes.size(), 4U);
  EXPECT_THAT(built->model.notes[0], AllOf(HasSubstr("\"ball\""), HasSubstr("no rotary inertia")));
  EXPECT_THAT(built->model.notes[3], HasSubstr("\"needle\""));
}

TEST(ModelBuilder, PointMassesKeepRotationsThatJointsTurn) {
  Described m;
  m.rigid("bob", 2, {0, -3, 0}, {0, 0, 0});
  m.joint<joints::SphericalSpec>("ball", "ground", "bob/origin");
  const auto built = m.build();
  const body::Body& bob = built->model.bodies[0];
  // All but that about the line to the joint.
  ASSERT_EQ(bob.rotation_basis.cols(), 2);
  EXPECT_NEAR(bob.rotation_basis.row(1).norm(), 0, 1e-12);
  ASSERT_EQ(bob.missing_rotations.cols(), 1);
  EXPECT_NEAR(std::abs(bob.missing_rotations(1, 0)), 1, 1e-12);
  EXPECT_NEAR(bob.stand_in(1, 1), 0, 1e-12);
  EXPECT_GT(bob.stand_in(0, 0), 0.0);
  EXPECT_LE(bob.stand_in(0, 0), 0.01 * 2 * 9 * (1 + 1e-12)) << "a hundredth of m l^2 at most";
  EXPECT_EQ(built->model.notes.size(), 1U);
}

TEST(ModelBuilder, PointMassesThatTurnTogetherWithoutInertiaAreRefused) {
  // The middle of the second is where it is hinged to the first: nothing gives both of them inertia
  // when they turn about the line through the ball joints.
  Described m;
  m.rigid("a", 1, {0, 0, 0}, {0, 0, 0});
  m.rigid("b", 1, {0, 0, 0}, {0, 0, 0});
  m.joint<joints::FixedSpec>("weld", "a", "b");
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("no rotary inertia"), HasSubstr("\"weld\""),
                                              HasSubstr("`inertia`"))));
}

TEST(ModelBuilder, BodiesWithoutMassAreRefused) {
  Described m;
  m.rigid("ghost", 0, {0, 0, 0}, {0, 0, 0});
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(StartsWith("test.yaml:10:1"), HasSubstr("\"ghost\""),
                                              HasSubstr("no mass"))));
}

TEST(ModelBuilder, RowsOfJointsFollowEachOther) {
  Described m;
  m.rigid("a", 1, {0, 0, 0}, {1, 1, 1});
  m.rigid("b", 1, {0, 0, 0}, {1, 1, 1});
  m.joint<joints::RevoluteSpec>("hinge", "ground", "a").axis = Vector3d::UnitZ();
  m.joint<joints::SphericalSpec>("ball", "a", "b");
  m.joint<joints::FixedSpec>("weld", "ground", "b");
  const auto built = m.build();
  const Model& model = built->model;
  EXPECT_EQ(model.num_constraint_rows(), 5 + 3 + 6);
  EXPECT_EQ(model.owner_of_row(0).first->name, "hinge");
  EXPECT_EQ(model.owner_of_row(4), std::make_pair(&model.joints[0], 4));
  EXPECT_EQ(model.owner_of_row(5), std::make_pair(&model.joints[1], 0));
  EXPECT_EQ(model.owner_of_row(13), std::make_pair(&model.joints[2], 5));
}

TEST(ModelBuilder, BushingsBecomeLoads) {
  Described m;
  m.rigid("a", 1, {0, 0, 0}, {1, 1, 1});
  m.joint<joints::BushingSpec>("mount", "ground", "a").stiffness = {1e3, 1e3, 1e3};
  const auto built = m.build();
  EXPECT_TRUE(built->model.joints.empty());
  ASSERT_EQ(built->model.loads.size(), 1U);
  EXPECT_EQ(built->model.loads[0].name, "mount");
  EXPECT_EQ(built->model.loads[0].element->num_soft_rows(), 6);
}

TEST(ModelBuilder, SectionsExistOnFlexibleBodiesOnly) {
  Described m;
  m.rigid("block", 1, {0, 0, 0}, {1, 1, 1});
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  m.sensor_of<SectionForceSensor>("s", "block");
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(AllOf(HasSubstr("\"block\""),
                                                                  HasSubstr("not on a flexible"))));
  m.d.output.sensors.clear();
  m.sensor_of<StressSensor>("s", "rod").element = 5;
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<InputError>(HasSubstr("has 4 elements, not 5")));
}

TEST(ModelBuilder, SectionsAreFoundByMarkerOrNumber) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4).markers = {Described::marker("p", {0.6, 0, 0})};
  m.sensor_of<SectionForceSensor>("start", "rod/start");
  m.sensor_of<SectionForceSensor>("mid", "rod/mid");
  m.sensor_of<SectionForceSensor>("end", "rod/end");
  m.sensor_of<SectionForceSensor>("inside", "rod/p");
  m.sensor_of<SectionForceSensor>("third", "rod").element = 3;
  m.sensor_of<StressSensor>("all", "rod");
  const auto built = m.build();
  const auto expect = [&](std::size_t k, int element, int end) {
    EXPECT_EQ(built->sensors[k].body, 0) << k;
    EXPECT_EQ(built->sensors[k].element, element) << k;
    EXPECT_EQ(built->sensors[k].end, end) << k;
  };
  expect(0, 0, 0);
  expect(1, 1, 1);  // the first element that touches the middle, its second end
  expect(2, 3, 1);
  expect(3, 2, 0);
  expect(4, 2, 0);
  expect(5, -1, 0);
}

TEST(ModelBuilder, LengthIsTheDiagonalOfEverythingPlaced) {
  Described m;
  m.beam("rod", {0, 0, 0}, {3, 0, 0}, 2);
  m.rigid("ball", 1, {0, 0, 0}, {1, 1, 1}).at.position = {0, 4, 0};
  EXPECT_NEAR(m.build()->model.length, 5, 1e-14);
  Described point;
  point.rigid("ball", 1, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(point.build()->model.length, 1);
}

TEST(ModelBuilder, PlacedStateIsAtRest) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 3).at.position = {0, 0, 7};
  m.joint<joints::SphericalSpec>("ball", "ground", "rod/start");
  const auto built = m.build();
  const State state = placed_state(built->model);
  ASSERT_EQ(state.bodies.size(), 1U);
  EXPECT_NEAR((state.bodies[0].frame.X_WB.p - Vector3d(0.5, 0, 7)).norm(), 0, 1e-15);
  EXPECT_EQ(state.bodies[0].frame.v, Vector3d::Zero());
  EXPECT_EQ(state.bodies[0].d.whole(), linalg::Vector::Zero(24));
  EXPECT_EQ(state.lambda, linalg::Vector::Zero(3));
}

}  // namespace
}  // namespace buckens::model
