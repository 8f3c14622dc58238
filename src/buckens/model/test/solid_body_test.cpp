// SPDX-License-Identifier: Apache-2.0
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/solid/recovery.h"
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

const Vector3d kSolidSize(0.4, 0.2, 0.2);

/// The eight corners of a cube, shifted along the diagonal of the x-y plane.
std::vector<fem::NodeSpec> cube_nodes(const std::string& prefix, const Vector3d& from) {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::vector<fem::NodeSpec> out;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    out.push_back({prefix + std::to_string(k), test::at_line(20), from + corners[k]});
  }
  return out;
}

fem::SolidMemberSpec solid(const std::vector<std::string>& nodes) {
  fem::SolidMemberSpec out;
  out.where = test::at_line(35);
  out.nodes = nodes;
  out.material.value.E = test::kE;
  out.material.value.nu = 0.3;
  out.material.value.rho = test::kRho;
  return out;
}

std::vector<std::string> names(const std::string& prefix) {
  std::vector<std::string> out;
  for (int k = 0; k < 8; ++k) out.push_back(prefix + std::to_string(k));
  return out;
}

TEST(SolidBody, BlocksHaveMassNodesAndNamedPlaces) {
  Described m;
  m.block("block", kSolidSize, {4, 2, 2});
  const Vector3d half = kSolidSize / 2;
  const std::map<std::string, Vector3d> places = {{"node_first", -half},
                                                  {"node_last", half},
                                                  {"corner_010", {-0.2, 0.1, -0.1}},
                                                  {"face_x1", {0.2, 0.0, 0.0}},
                                                  {"centre", {0, 0, 0}}};
  for (const auto& [name, place] : places) m.sensor_of<PositionSensor>(name, "block/" + name);
  const auto built = m.build();
  const body::Body& body = built->model.bodies[0];
  EXPECT_EQ(body.num_dofs(), 3 * 5 * 3 * 3);
  // Rounding of sums over elements.
  EXPECT_NEAR(body.mass, test::kRho * kSolidSize.prod(), 1e-12);
  EXPECT_NEAR((body.com - half).norm(), 0, 1e-15);
  for (const auto& [name, place] : places) {
    EXPECT_NEAR((marker(*built, name).X_BF.p - place).norm(), 0, 1e-14) << name;
    EXPECT_TRUE(marker(*built, name).follows_mesh()) << name;
    EXPECT_FALSE(marker(*built, name).carries_moment()) << name;
  }
}

TEST(SolidBody, MarkersByCoordinatesHitANode) {
  Described m;
  m.block("block", kSolidSize, {4, 2, 2}).markers = {Described::marker("p", {0.3, 0.1, 0.2})};
  EXPECT_TRUE(marker(*m.build(), "p").follows_mesh());
  m.d.bodies[0].markers = {Described::marker("p", {0.3, 0.13, 0.2})};
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(AllOf(
                  HasSubstr("test.yaml:40:1"), HasSubstr("\"p\""), HasSubstr("(0.3, 0.13, 0.2) m"),
                  HasSubstr("(0.3, 0.1, 0.2) m, 0.03 m away"), HasSubstr("divide the mesh"))));
}

TEST(SolidBody, JointsThatHoldADirectionAreRefused) {
  Described m;
  m.block("block", kSolidSize, {2, 2, 2});
  m.joint<joints::RevoluteSpec>("hinge", "ground", "block/face_x0").axis = Vector3d::UnitZ();
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("test.yaml:50:1"), HasSubstr("\"hinge\""),
                                              HasSubstr("solids have no rotations"),
                                              HasSubstr("spherical joints at several nodes"))));
  m.d.joints.clear();
  m.joint<joints::SphericalSpec>("ball", "ground", "block/face_x0");
  EXPECT_EQ(m.build()->model.num_constraint_rows(), 3);
}

TEST(SolidBody, PlanarModelsKeepEveryTranslationAndSieveAllRigidMotion) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.block("block", kSolidSize, {2, 2, 2});
  m.joint<joints::RevoluteSpec>("hinge", "ground", "block/face_x0");
  const auto built = m.build();
  const body::Body& body = built->model.bodies[0];
  EXPECT_EQ(body.num_dofs(), 3 * 27);
  EXPECT_EQ(body.flexible->sieve.Phi().cols(), 6);
  EXPECT_EQ(body.rotation_basis.cols() + body.translation_basis.cols(), 3);
}

TEST(SolidBody, PointMassesSitOnNamedNodesAndHaveNoInertiaThere) {
  Described m;
  body::BodySpec& spec = m.block("block", kSolidSize, {2, 2, 2});
  auto& mesh = std::get<fem::MeshSpec>(spec.kind);
  fem::PointMassSpec mass;
  mass.at = "node_last";
  mass.mass = test::kRho * kSolidSize.prod();
  mesh.masses = {mass};
  EXPECT_NEAR((m.build()->model.bodies[0].com - 0.75 * kSolidSize).norm(), 0, 1e-14);
  mesh.masses[0].inertia = {1, 1, 1};
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("\"block\""), HasSubstr("no rotations"))));
}

TEST(SolidBody, MaterialsThatNoSolidHasAreRefusedWithThePlace) {
  Described m;
  body::BodySpec& spec = m.block("block", kSolidSize, {1, 1, 1});
  std::get<fem::MeshSpec>(spec.kind).material->value.nu = 0.5;
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("test.yaml:10:1"), HasSubstr("\"block\""),
                                              HasSubstr("use 0.49 for rubber"))));
}

TEST(SolidBody, SingleElementsJoinAtNodesOfAStructure) {
  Described m;
  fem::StructureSpec kind;
  kind.nodes = cube_nodes("a", {0, 0, 0});
  kind.nodes.push_back({"tip", test::at_line(21), {2, 1, 1}});
  kind.solids = {solid(names("a"))};
  fem::BarMemberSpec bar;
  bar.area = 1e-4;
  bar.material = kind.solids[0].material;
  for (const char* node : {"a1", "a2", "a5", "a6"}) {
    bar.between = {node, "tip"};
    kind.bars.push_back(bar);
  }
  m.body("lump").kind = kind;
  const auto built = m.build();
  EXPECT_EQ(fem::num_solids(built->model.bodies[0].flexible->fe), 1);
  EXPECT_EQ(built->model.bodies[0].num_dofs(), 27);
}

TEST(SolidBody, ElementsInsideOutAreRefused) {
  Described m;
  fem::StructureSpec kind;
  kind.nodes = cube_nodes("a", {0, 0, 0});
  kind.solids = {solid({"a4", "a5", "a6", "a7", "a0", "a1", "a2", "a3"})};
  m.body("lump").kind = kind;
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<ModelError>(
                                      AllOf(HasSubstr("\"lump\""), HasSubstr("inverted or flat"))));
}

TEST(SolidBody, CubesThatShareAnEdgeAreAMechanism) {
  Described m;
  fem::StructureSpec kind;
  kind.nodes = cube_nodes("a", {0, 0, 0});
  for (auto& node : cube_nodes("b", {1, 1, 0})) kind.nodes.push_back(node);
  std::vector<std::string> second = names("b");
  second[0] = "a2";
  second[4] = "a6";
  std::erase_if(kind.nodes, [](const auto& n) { return n.name == "b0" || n.name == "b4"; });
  kind.solids = {solid(names("a")), solid(second)};
  m.body("pair").kind = kind;
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("\"pair\""), HasSubstr("mechanism"))));
}

TEST(SolidBody, StressesAreFoundByNodeOrNumber) {
  Described m;
  m.block("block", kSolidSize, {4, 2, 2});
  m.sensor_of<StressSensor>("all", "block");
  m.sensor_of<StressSensor>("corner", "block/corner_000");
  m.sensor_of<StressSensor>("middle", "block/centre");
  m.sensor_of<StressSensor>("numbered", "block").element = 16;
  const auto built = m.build();
  EXPECT_TRUE(built->sensors[0].solids.empty());
  EXPECT_THAT(built->sensors[1].solids, ElementsAre(0));
  EXPECT_EQ(built->sensors[2].solids.size(), 8u);
  EXPECT_THAT(built->sensors[3].solids, ElementsAre(15));
  std::get<StressSensor>(m.d.output.sensors[3].kind).element = 17;
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(HasSubstr("body \"block\" has 16 elements, not 17")));
  m.d.output.sensors.clear();
  m.sensor_of<SectionForceSensor>("cut", "block/centre");
  EXPECT_THAT([&] { m.build(); }, ThrowsMessage<ModelError>(HasSubstr("observe their `stress`")));
}

class DividedBlock : public testing::TestWithParam<fem::SolidKind> {};

TEST_P(DividedBlock, PartsHangTogetherByFaces) {
  Described m;
  body::BodySpec& spec = m.block("block", kSolidSize, {6, 3, 3});
  spec.frames.count = 5;
  // Quadratic elements that share an edge have three nodes in common, as many as a triangle.
  std::get<fem::BoxMeshSpec>(std::get<fem::MeshSpec>(spec.kind).shape).element = GetParam();
  const auto built = m.build();
  ASSERT_EQ(built->model.bodies.size(), 5u);
  double mass = 0;
  std::size_t solids = 0;
  for (const body::Body& part : built->model.bodies) {
    EXPECT_TRUE(fem::solids_join_by_faces(part.flexible->fe)) << part.name;
    mass += part.mass;
    solids += static_cast<std::size_t>(fem::num_solids(part.flexible->fe));
  }
  EXPECT_NEAR(mass, built->model.wholes[0].mass, 1e-11);
  EXPECT_EQ(built->model.wholes[0].solids.size(), solids);
  // A tie holds the place of a node: three rows per copy beyond the first.
  for (const Joint& tie : built->model.joints) EXPECT_EQ(tie.rows.size(), 3u);
}

INSTANTIATE_TEST_SUITE_P(SolidBody, DividedBlock,
                         testing::Values(fem::SolidKind::hex8, fem::SolidKind::hex20,
                                         fem::SolidKind::tet10),
                         [](const auto& kind) {
                           return choice_names(kind.param)[static_cast<std::size_t>(kind.param)];
                         });

}  // namespace
}  // namespace buckens::model
