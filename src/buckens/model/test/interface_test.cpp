// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"
#include "buckens/model/test/marker_of.h"

namespace buckens::model {
namespace {

using Eigen::Vector3d;
using test::Described;
using test::marker;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Vector3d kSize(0.4, 0.2, 0.2);

body::InterfaceSpec interface(const std::string& name, fem::RegionSpec region,
                              body::InterfaceKind kind = body::InterfaceKind::average) {
  body::InterfaceSpec out;
  out.name = name;
  out.where = test::at_line(45);
  std::visit([](auto& spec) { spec.where = test::at_line(46); }, region);
  out.region = std::move(region);
  out.kind = kind;
  return out;
}

fem::NamedFaceSpec face(const std::string& name) { return {test::at_line(46), name}; }

fem::NodeSetSpec set(const std::vector<std::string>& nodes) { return {test::at_line(46), nodes}; }

fem::SphereSelection ball(const Vector3d& center, double radius) {
  fem::SphereSelection out;
  out.center = center;
  out.radius = radius;
  return out;
}

Described block(const std::vector<body::InterfaceSpec>& interfaces) {
  Described m;
  m.block("block", kSize, {4, 2, 2}).interfaces = interfaces;
  return m;
}

/// The message of the error when the model is built.
template <class Error>
void expect_refused(const Described& m, const std::vector<std::string>& words) {
  try {
    m.build();
  } catch (const Error& error) {
    for (const std::string& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
    return;
  }
  ADD_FAILURE() << "nothing was thrown";
}

TEST(Interfaces, AreMarkersThatCarryMoments) {
  Described m = block({interface("hinge", face("x0"))});
  m.joint<joints::RevoluteSpec>("pin", "ground", "block/hinge").axis = Vector3d::UnitZ();
  const auto built = m.build();
  EXPECT_EQ(built->model.num_constraint_rows(), 5);
  const body::Marker& hinge = marker(*built, "hinge");
  EXPECT_TRUE(hinge.follows_mesh());
  EXPECT_TRUE(hinge.carries_moment());
  EXPECT_NEAR((hinge.X_BF.p - Vector3d(-0.2, 0, 0)).norm(), 0, 1e-14);
  EXPECT_EQ(built->model.bodies[0].num_interface_rows(), 6);
  const InterfaceRegion& region = built->model.wholes[0].interfaces.at(0);
  EXPECT_EQ(region.region.nodes.size(), 9u);
  EXPECT_NEAR(region.region.area, 0.04, 1e-16);
}

TEST(Interfaces, HaveTheirOwnPlaceAndAxes) {
  auto spec = interface("hinge", face("x0"));
  spec.at = Vector3d(-0.1, 0.1, 0.1);
  spec.orientation.emplace();
  spec.orientation->axis = Vector3d::UnitZ();
  spec.orientation->angle = 0.5;
  Described m = block({spec});
  body::MarkerSpec turned = Described::marker("turned", {0, 0, 0});
  turned.position.reset();
  turned.at = "hinge";
  m.d.bodies[0].markers = {turned};
  const auto built = m.build();
  const body::Marker& hinge = marker(*built, "hinge");
  EXPECT_NEAR((hinge.X_BF.p - Vector3d(-0.3, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((hinge.X_BF.q * Vector3d::UnitX() - Vector3d(std::cos(0.5), std::sin(0.5), 0)).norm(),
              0, 1e-15);
  // A marker at an interface shares its rows but not its axes.
  EXPECT_EQ(marker(*built, "turned").translation_row, hinge.translation_row);
  EXPECT_EQ(marker(*built, "turned").X_BF.q.w(), 1);
}

TEST(Interfaces, SelectByPlaceWithTolerance) {
  fem::BoxSelection box;
  box.from = {0.3, 0, 0};
  box.to = {0.3999, 0.2, 0.2};
  Described m = block({interface("a", box)});
  EXPECT_EQ(m.build()->model.wholes[0].interfaces[0].region.nodes.size(), 9u);
  box.tolerance = 1e-3;
  m.d.bodies[0].interfaces = {interface("a", box)};
  EXPECT_EQ(m.build()->model.wholes[0].interfaces[0].region.nodes.size(), 18u);
  fem::CylinderSelection bar;
  bar.from = {0, 0.1, 0.1};
  bar.to = {0.4, 0.1, 0.1};
  bar.radius = 0.01;
  m.d.bodies[0].interfaces = {interface("a", bar)};
  EXPECT_EQ(m.build()->model.wholes[0].interfaces[0].region.nodes.size(), 5u);
}

TEST(Interfaces, SayHowFarTheNearestNodeIs) {
  expect_refused<InputError>(
      block({interface("hole", ball({0.45, 0.1, 0.1}, 0.02))}),
      {"test.yaml:46:1", "interface \"hole\" of body \"block\"", "no node lies in the sphere",
       "(0.4, 0.1, 0.1) m", "0.03 m away", "larger `tolerance`"});
}

TEST(Interfaces, NameTheFacesAndNodesThatThereAre) {
  expect_refused<InputError>(block({interface("a", face("x2"))}),
                             {"test.yaml:46:1", "no face \"x2\"", "Did you mean \"x0\"?"});
  expect_refused<InputError>(block({interface("a", set({"corner_000", "corner_020"}))}),
                             {"no node or set \"corner_020\"", "Did you mean \"corner_0"});
  expect_refused<InputError>(block({interface("a", set({}))}), {"the set is empty"});
}

TEST(Interfaces, BelongToSolids) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 2).interfaces = {interface("a", ball({0, 0, 0}, 0.1))};
  expect_refused<InputError>(m,
                             {"test.yaml:45:1", "belong to meshes of solids", "markers at nodes"});
}

TEST(Interfaces, OnALineCarryForcesOnly) {
  const auto edge = interface("edge", set({"corner_000", "corner_001"}));
  fem::CylinderSelection line;
  line.to = {0, 0, 0.2};
  Described m = block({edge, interface("line", line)});
  m.joint<joints::SphericalSpec>("ball", "ground", "block/edge");
  EXPECT_FALSE(marker(*m.build(), "edge").carries_moment());
  m.d.joints.clear();
  m.joint<joints::RevoluteSpec>("pin", "ground", "block/edge").axis = Vector3d::UnitY();
  expect_refused<ModelError>(m, {"test.yaml:50:1", "joint \"pin\": \"block/edge\" cannot carry",
                                 "it has 2 nodes", "three are needed", "span a surface"});
  m.d.joints.clear();
  m.torque("turn", "block/line", {1, 0, 0});
  expect_refused<ModelError>(m, {"load \"turn\"", "3 nodes lie on one line", "about it"});
}

TEST(Interfaces, OnALineAreNotHeldRigidNorOffTheirCentre) {
  auto spec = interface("edge", set({"corner_000", "corner_001"}), body::InterfaceKind::rigid);
  expect_refused<InputError>(
      block({spec}), {"test.yaml:45:1", "it has 2 nodes", "or make the interface `average`"});
  spec.kind = body::InterfaceKind::average;
  spec.at = Vector3d(0.1, 0, 0);
  expect_refused<InputError>(block({spec}), {"a force at `at`, off their centre, needs one"});
  spec.at = Vector3d(0, 0, 0.1);
  EXPECT_NO_THROW(block({spec}).build());
}

TEST(Interfaces, StayInOneFrameOrAreRefused) {
  Described m = block({interface("hinge", face("x0")), interface("hand", face("x1"))});
  m.d.bodies[0].frames.count = 2;
  m.joint<joints::RevoluteSpec>("pin", "ground", "block/hinge").axis = Vector3d::UnitZ();
  const auto built = m.build();
  ASSERT_EQ(built->model.bodies.size(), 2u);
  const Joint& pin = built->model.joints.back();
  const body::Body& part = built->model.bodies[static_cast<std::size_t>(pin.second.body)];
  const body::Marker& hinge = part.markers[static_cast<std::size_t>(pin.second.marker)];
  EXPECT_NEAR((part.com + hinge.X_BF.p - Vector3d(0, 0.1, 0.1)).norm(), 0, 1e-14);
  EXPECT_NE(part.find_marker("hinge") >= 0, part.find_marker("hand") >= 0);
  m.d.bodies[0].interfaces = {interface("long", face("y0"))};
  m.d.joints.clear();
  expect_refused<ModelError>(m, {"test.yaml:10:1", "\"block\"", "interface \"long\"",
                                 "several of its 2 frames", "fewer frames or a smaller region"});
}

TEST(Interfaces, RigidOnesTakeTheirNodesAway) {
  Described m = block({interface("hinge", face("x0"), body::InterfaceKind::rigid)});
  m.joint<joints::RevoluteSpec>("pin", "ground", "block/hinge").axis = Vector3d::UnitZ();
  m.sensor_of<PositionSensor>("corner", "block/corner_000");
  const auto built = m.build();
  const body::Body& body = built->model.bodies[0];
  EXPECT_EQ(body.num_dofs(), 3 * (45 - 9) + 6);
  EXPECT_EQ(body.flexible->mesh().dofs.num_dofs, 3 * 45);
  // Its frame is the one node that is left of the region, so the rows are unit rows.
  const Eigen::MatrixXd rows = body.flexible->rows.topRows(6);
  EXPECT_NEAR((rows.rightCols(6) - Eigen::MatrixXd::Identity(6, 6)).norm(), 0, 1e-13);
  EXPECT_EQ(body.flexible->rows.topRows(6).eval().nonZeros(), 6);
  // A node of the region follows it: u + θ × r.
  const body::Marker& corner = marker(*built, "corner_000");
  linalg::Vector d = linalg::Vector::Zero(body.num_dofs());
  d.tail<6>() << 1, 2, 3, 0.1, 0.2, 0.3;
  const Vector3d moved = (body.flexible->rows * d).segment<3>(corner.translation_row);
  const Vector3d expected =
      Vector3d(1, 2, 3) + Vector3d(0.1, 0.2, 0.3).cross(Vector3d(0, -0.1, -0.1));
  EXPECT_NEAR((moved - expected).norm(), 0, 1e-14);
}

TEST(Interfaces, RigidOnesLieInOnePartOfADividedBody) {
  Described m = block({interface("hinge", face("x0"), body::InterfaceKind::rigid)});
  m.d.bodies[0].frames.count = 2;
  const auto built = m.build();
  const Model& model = built->model;
  int eliminated = 0;
  for (const body::Body& part : model.bodies) {
    // The nodes of the face lose their variables, which are replaced by six of the region.
    if (part.num_dofs() == static_cast<Eigen::Index>(part.flexible->mesh().dofs.num_dofs)) continue;
    ++eliminated;
    const auto lost = 3 * model.wholes[0].interfaces[0].region.nodes.size() - 6;
    EXPECT_EQ(part.num_dofs(), part.flexible->mesh().dofs.num_dofs - static_cast<int>(lost));
  }
  EXPECT_EQ(eliminated, 1);
}

TEST(Interfaces, RigidOnesHaveNoNodeInCommon) {
  expect_refused<ModelError>(
      block({interface("a", face("x0"), body::InterfaceKind::rigid),
             interface("b", face("y0"), body::InterfaceKind::rigid)}),
      {"test.yaml:10:1", "\"a\" (9 nodes)", "\"b\" (15 nodes)", "3 nodes in common", "`average`"});
  EXPECT_NO_THROW(
      block({interface("a", face("x0"), body::InterfaceKind::rigid), interface("b", face("y0"))})
          .build());
}

TEST(Interfaces, RigidOnesAndGeometricStiffnessExcludeEachOther) {
  // Solids alone have no geometric stiffness, so a bar lies along an edge.
  Described m;
  m.truss("block", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}, {"c", {0, 1, 0}}, {"d", {0, 0, 1}}},
          {{"a", "b"}});
  auto& structure = std::get<fem::StructureSpec>(m.d.bodies[0].kind);
  fem::SolidMemberSpec solid;
  solid.element = fem::SolidKind::tet4;
  solid.nodes = {"a", "b", "c", "d"};
  solid.material = structure.bars[0].material;
  structure.solids = {solid};
  m.d.bodies[0].interfaces = {interface("hinge", set({"a", "c", "d"}), body::InterfaceKind::rigid)};
  m.d.bodies[0].geometric_stiffness = true;
  expect_refused<ModelError>(m, {"test.yaml:10:1", "\"block\"", "geometric stiffness",
                                 "rigid interface \"hinge\"", "`average`"});
}

TEST(Interfaces, ObserveStressInTheElementsAround) {
  Described m = block({interface("hinge", face("x0"))});
  m.sensor_of<StressSensor>("root", "block/hinge");
  EXPECT_THAT(m.build()->sensors[0].solids, ElementsAre(0, 4, 8, 12));
}

}  // namespace
}  // namespace buckens::model
