// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/fem/mesh/cell_measure.h"
#include "buckens/fem/mesh/report.h"
#include "buckens/fem/mesh/straighten.h"

namespace buckens::fem {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Corners, then the middles of the edges where the kind has them.
std::vector<Vector3d> with_middles(CellKind kind, std::vector<Vector3d> x) {
  if (num_nodes(kind) == num_corners(kind)) return x;
  for (const auto& [a, b] : cell_edges(kind)) {
    x.push_back(0.5 * (x[static_cast<std::size_t>(a)] + x[static_cast<std::size_t>(b)]));
  }
  return x;
}

const std::vector<Vector3d> kTetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Vector3d> kWedge = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                      {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
const std::vector<Vector3d> kPyramid = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 3}};
const std::vector<Vector3d> kBlock = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}};

TEST(CellMeasure, KnowsVolumesOfEveryKind) {
  const auto volume = [](CellKind kind, const std::vector<Vector3d>& corners) {
    return cell_measure(kind, with_middles(kind, corners)).size;
  };
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(volume(CellKind::tet4, kTetrahedron), 1.0 / 6.0, kRounding);
  EXPECT_NEAR(volume(CellKind::tet10, kTetrahedron), 1.0 / 6.0, kRounding);
  EXPECT_NEAR(volume(CellKind::wedge6, kWedge), 1.0, kRounding);
  EXPECT_NEAR(volume(CellKind::wedge15, kWedge), 1.0, kRounding);
  EXPECT_NEAR(volume(CellKind::pyramid5, kPyramid), 1.0, kRounding);
  EXPECT_NEAR(volume(CellKind::hex8, kBlock), 2.0, kRounding);
  EXPECT_NEAR(volume(CellKind::hex20, kBlock), 2.0, kRounding);
  const CellMeasure block = cell_measure(CellKind::hex8, kBlock);
  EXPECT_LT((block.first - Vector3d(2, 1, 1)).norm(), kRounding);
  EXPECT_NEAR(block.second(0, 0), 8.0 / 3.0, 1e-13);
  const CellMeasure square =
      cell_measure(CellKind::quad4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_NEAR(square.size, 1.0, kRounding);
  EXPECT_NEAR(square.second(0, 0), 1.0 / 3.0, kRounding);
  EXPECT_NEAR(square.second(0, 1), 0.25, kRounding);
}

TEST(CellMeasure, TellsInvertedElements) {
  for (const auto& [kind, corners] :
       {std::pair{CellKind::tet4, kTetrahedron}, std::pair{CellKind::wedge6, kWedge},
        std::pair{CellKind::pyramid5, kPyramid}, std::pair{CellKind::hex20, kBlock}}) {
    auto x = with_middles(kind, corners);
    EXPECT_FALSE(is_inverted(kind, x)) << name_of(kind);
    for (Vector3d& place : x) place.z() = -place.z();
    EXPECT_TRUE(is_inverted(kind, x)) << name_of(kind);
  }
}

TEST(CellMeasure, GivesOneToTheBestShapes) {
  const double height = std::sqrt(3.0) / 2.0;
  const std::vector<Vector3d> regular = {
      {0, 0, 0}, {1, 0, 0}, {0.5, height, 0}, {0.5, height / 3.0, std::sqrt(2.0 / 3.0)}};
  EXPECT_NEAR(aspect_ratio(CellKind::tet4, regular), 1.0, 1e-12);
  EXPECT_NEAR(aspect_ratio(CellKind::tri3, {regular[0], regular[1], regular[2]}), 1.0, 1e-12);
  EXPECT_NEAR(aspect_ratio(CellKind::hex8, kBlock), 2.0, 1e-12);
  auto flat = kTetrahedron;
  flat[3] = {0.3, 0.3, 0};
  EXPECT_GT(aspect_ratio(CellKind::tet4, flat), 1e12);
  for (const CellKind kind : {CellKind::tri3, CellKind::quad4, CellKind::tet4, CellKind::hex8}) {
    const std::vector<Vector3d> point(static_cast<std::size_t>(num_nodes(kind)), {1, 2, 3});
    EXPECT_EQ(aspect_ratio(kind, point), std::numeric_limits<double>::infinity());
  }
}

TEST(MeshReport, RemembersAnElementWithoutSize) {
  ImportedMesh mesh;
  for (const double x : {0.0, 0.0, 0.0, 1.0, 2.0}) mesh.positions.emplace_back(x, x * x, 0);
  mesh.node_ids = {1, 2, 3, 4, 5};
  ImportedBlock block;
  block.kind = CellKind::tri3;
  block.ids = {11, 12};
  block.nodes = {0, 1, 2, 0, 3, 4};  // the first one is a point
  mesh.blocks = {block};
  EXPECT_EQ(report_mesh(mesh, true).worst_element, 11);
}

/// A steel block of 2 m x 1 m x 1 m with a point mass and a node that nothing uses.
ImportedMesh block_mesh() {
  ImportedMesh mesh;
  mesh.file = "block.inp";
  mesh.positions = kBlock;
  mesh.positions.emplace_back(9, 9, 9);
  for (int id = 1; id <= 9; ++id) mesh.node_ids.push_back(10 * id);
  MaterialSpec steel;
  steel.name = "steel";
  steel.E = 2.1e11;
  steel.rho = 1000;
  mesh.materials = {steel};
  ImportedProperty property;
  property.name = "BLOCK";
  property.material = "steel";
  mesh.properties = {property};
  ImportedBlock block;
  block.kind = CellKind::hex8;
  block.property = 0;
  block.ids = {7};
  block.nodes = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.blocks = {block};
  mesh.face_sets = {{"top", {{0, {4, 5, 6, 7}}}}};
  mesh.masses = {{0, 2000.0, Eigen::Matrix3d::Identity(), Vector3d::Zero()}};
  return mesh;
}

TEST(MeshReport, CountsAndMeasures) {
  const MeshReport report = report_mesh(block_mesh(), true);
  EXPECT_EQ(report.nodes, 9);
  EXPECT_EQ(report.variables, 24);
  EXPECT_THAT(report.free_nodes, ElementsAre(90));
  EXPECT_EQ(report.pieces, 1);
  EXPECT_NEAR(report.volume, 2.0, 1e-12);
  EXPECT_NEAR(report.mass, 4000.0, 1e-9);
  EXPECT_LT((report.mass_centre - Vector3d(0.5, 0.25, 0.25)).norm(), 1e-12);
  // Block about its centre and both moved to the common one: 2000 (1/12 (1 + 1) + d_b²) + 1 + …
  const double moved = 2000.0 * 2.0 * (0.0625 + 0.0625);
  EXPECT_NEAR(report.inertia(0, 0), 2000.0 / 6.0 + 1.0 + moved, 1e-9);
  EXPECT_NEAR(report.face_sets[0].area, 2.0, 1e-12);
  EXPECT_LT((report.face_sets[0].centre - Vector3d(1, 0.5, 1)).norm(), 1e-12);
  EXPECT_EQ(report.worst_element, 7);
  EXPECT_THAT(report.inverted, IsEmpty());
  EXPECT_THAT(report.warnings, IsEmpty());
}

TEST(MeshReport, FindsNodesAtOnePlaceAndPieces) {
  ImportedMesh mesh = block_mesh();
  for (int k = 0; k < 8; ++k) {
    mesh.positions.push_back(kBlock[static_cast<std::size_t>(k)] + Vector3d(2, 0, 0));
    mesh.node_ids.push_back(200 + k);
    mesh.blocks[0].nodes.push_back(9 + k);
  }
  mesh.blocks[0].ids.push_back(8);
  const MeshReport report = report_mesh(mesh, true);
  EXPECT_EQ(report.pieces, 2);
  using Pair = std::pair<std::int64_t, std::int64_t>;
  EXPECT_THAT(report.duplicate_nodes,
              ElementsAre(Pair(20, 200), Pair(30, 203), Pair(60, 204), Pair(70, 207)));
  mesh.rigid_links.push_back({"tie", 0, {9}, {true, true, true, true, true, true}, 0});
  EXPECT_EQ(report_mesh(mesh, true).pieces, 1);
}

TEST(MeshReport, DoubtsUnits) {
  ImportedMesh mesh = block_mesh();
  for (Vector3d& place : mesh.positions) place *= 150;
  mesh.materials[0].E = 210000;
  mesh.materials[0].rho = 7.85e-9;
  const MeshReport report = report_mesh(mesh, false);
  ASSERT_EQ(report.warnings.size(), 3u);
  EXPECT_THAT(report.warnings[0], HasSubstr("1350 m wide"));
  EXPECT_THAT(report.warnings[0], HasSubstr("`length-unit: mm`"));
  EXPECT_THAT(report.warnings[1], HasSubstr("E = 210000 Pa"));
  EXPECT_THAT(report.warnings[2], HasSubstr("7.85e-09 kg/m^3"));
  EXPECT_THAT(report_mesh(in_si(mesh, 1e-3, 1e3), true).warnings, IsEmpty());
}

TEST(Straighten, TurnsElementsOutwardAgain) {
  ImportedMesh mesh;
  mesh.positions = with_middles(CellKind::tet10, kTetrahedron);
  for (int id = 1; id <= 10; ++id) mesh.node_ids.push_back(id);
  ImportedBlock block;
  block.kind = CellKind::tet10;
  block.ids = {1};
  block.nodes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  mesh.blocks = {block};
  EXPECT_EQ(straighten_inverted(mesh), 0);
  mesh.positions[5] = Vector3d(0.1, 0.1, 0.3);  // the edge 12 bulges through the element
  ASSERT_THAT(report_mesh(mesh, true).inverted, ElementsAre(1));
  EXPECT_EQ(straighten_inverted(mesh), 1);
  EXPECT_EQ(mesh.positions[5], Vector3d(0.5, 0.5, 0));
  EXPECT_THAT(report_mesh(mesh, true).inverted, IsEmpty());
}

}  // namespace
}  // namespace buckens::fem
