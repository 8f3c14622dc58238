// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/test/replaced.h"

namespace buckens::mesh_io {
namespace {

using fem::CellKind;
using fem::ImportedMesh;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two tetrahedra of two groups, the triangle between ground and the first, an edge and a point.
constexpr char kTwo22[] = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
0 1 "tip"
1 2 "edge"
2 3 "ground"
3 4 "left"
3 5 "right"
$EndPhysicalNames
$Nodes
5
10 0 0 0
20 1 0 0
30 0 1 0
40 0 0 1
50 1 1 1.5e0
$EndNodes
$Elements
6
1 15 2 1 1 50
2 1 2 2 1 10 20
3 2 2 3 1 10 30 20
4 4 2 4 1 10 20 30 40
5 4 2 5 2 20 30 40 50
6 4 2 4 2 20 30 40 50
$EndElements
)";

constexpr char kTwo41[] = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 3 "ground"
3 4 "left"
$EndPhysicalNames
$Entities
1 0 1 1
7 0 0 0 0
1 0 0 0 1 1 0 1 3 0
1 0 0 0 1 1 1 1 4 1 1
$EndEntities
$Nodes
2 4 10 40
2 1 0 3
10
20
30
0 0 0
1 0 0
0 1 0
3 1 1 1
40
0 0 1 0.5 0.5 0.5
$EndNodes
$Elements
2 2 1 2
2 1 2 1
1 10 30 20
3 1 4 1
2 10 20 30 40
$EndElements
$NodeData
1
"x"
0
0
$EndNodeData
)";

std::string gmsh_message(const std::string& bytes, const std::string& file = "part.msh") {
  try {
    read_gmsh_bytes(bytes, file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GmshMesh, TakesGroupsAsPropertiesAndSets) {
  const ImportedMesh mesh = read_gmsh_bytes(kTwo22, "part.msh");
  EXPECT_EQ(mesh.format, "Gmsh 2.2 text");
  EXPECT_THAT(mesh.node_ids, ElementsAre(10, 20, 30, 40, 50));
  EXPECT_EQ(mesh.positions[4], Eigen::Vector3d(1, 1, 1.5));
  // Element 6 repeats element 5 for its second group.
  ASSERT_EQ(mesh.num_elements(), 2);
  ASSERT_EQ(mesh.blocks.size(), 2u);
  EXPECT_EQ(mesh.properties[static_cast<std::size_t>(mesh.blocks[0].property)].name, "left");
  EXPECT_THAT(mesh.blocks[1].ids, ElementsAre(5));
  ASSERT_EQ(mesh.element_sets.size(), 2u);
  EXPECT_EQ(mesh.element_sets[0].name, "left");
  EXPECT_THAT(mesh.element_sets[0].elements, ElementsAre(0, 1));
  EXPECT_THAT(mesh.element_sets[1].elements, ElementsAre(1));
  // The triangle is a side of the first tetrahedron, seen from outside.
  ASSERT_EQ(mesh.face_sets.size(), 1u);
  EXPECT_EQ(mesh.face_sets[0].name, "ground");
  EXPECT_EQ(mesh.face_sets[0].faces[0].element, 0);
  EXPECT_THAT(mesh.face_sets[0].faces[0].corners, ElementsAre(0, 2, 1));
  ASSERT_EQ(mesh.node_sets.size(), 5u);
  EXPECT_EQ(mesh.node_sets[0].name, "tip");
  EXPECT_THAT(mesh.node_sets[0].nodes, ElementsAre(4));
  EXPECT_EQ(mesh.node_sets[1].name, "edge");
  EXPECT_THAT(mesh.node_sets[1].nodes, ElementsAre(0, 1));
}

TEST(GmshMesh, TakesGroupsOfEntities) {
  const ImportedMesh mesh = read_gmsh_bytes(kTwo41, "part.msh");
  EXPECT_EQ(mesh.format, "Gmsh 4.1 text");
  EXPECT_EQ(mesh.positions[3], Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(mesh.properties[0].name, "left");
  EXPECT_THAT(mesh.face_sets[0].faces[0].corners, ElementsAre(0, 2, 1));
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_THAT(mesh.notes[0].text, HasSubstr("$NodeData"));
}

TEST(GmshMesh, TakesSurfacesForShellsWhereNoVolumeIs) {
  const std::string text = test::replaced(test::replaced(kTwo41, "3 1 4 1\n2 10 20 30 40\n", ""),
                                          "2 2 1 2\n2 1 2 1", "1 1 1 1\n2 1 2 1");
  const ImportedMesh mesh = read_gmsh_bytes(text, "part.msh");
  ASSERT_EQ(mesh.num_elements(), 1);
  EXPECT_EQ(mesh.blocks[0].kind, CellKind::tri3);
  EXPECT_EQ(mesh.properties[0].kind, fem::PropertyKind::shell);
  EXPECT_EQ(mesh.element_sets[0].name, "ground");
  // The side to which the normal points is a face for loads.
  ASSERT_EQ(mesh.face_sets.size(), 1u);
  EXPECT_EQ(mesh.face_sets[0].name, "ground");
  EXPECT_THAT(mesh.face_sets[0].faces[0].corners, testing::ElementsAreArray(mesh.blocks[0].nodes));
}

TEST(GmshMesh, GroupsOnOthersBecomeElementsWhereAModelNamesThem) {
  const ImportedMesh mesh = read_gmsh_bytes(kTwo22, "part.msh", {"ground", "edge"});
  ASSERT_EQ(mesh.blocks.size(), 4u);
  EXPECT_EQ(mesh.blocks[2].kind, CellKind::tri3);
  EXPECT_EQ(mesh.properties[static_cast<std::size_t>(mesh.blocks[2].property)].name, "ground");
  EXPECT_EQ(mesh.blocks[3].kind, CellKind::line2);
  EXPECT_EQ(mesh.properties[static_cast<std::size_t>(mesh.blocks[3].property)].kind,
            fem::PropertyKind::beam);
  // Loads still find the face of the solid under the skin.
  EXPECT_EQ(mesh.face_sets.at(0).faces.at(0).element, 0);
}

TEST(GmshMesh, ElementsSideBySideAreSeveralInVersion4) {
  ImportedMesh mesh;
  mesh.file = "bars.msh";
  mesh.node_ids = {1, 2};
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.blocks.resize(1);
  mesh.blocks[0].kind = CellKind::line2;
  mesh.blocks[0].ids = {1, 2};
  mesh.blocks[0].nodes = {0, 1, 0, 1};
  const auto count = [&](GmshFormat format) {
    return read_gmsh_bytes(gmsh_bytes(mesh, format), "bars.msh").num_elements();
  };
  EXPECT_EQ(count(GmshFormat::ascii_4_1), 2);
  EXPECT_EQ(count(GmshFormat::ascii_2_2), 1) << "there, one element of two groups is written twice";
}

TEST(GmshMesh, GroupsOfOneNameBelongTogether) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"skin\"\n2 2 \"skin\"\n"
      "3 3 \"block\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n3\n1 2 2 1 1 1 2 3\n2 2 2 2 2 1 2 4\n3 4 2 3 3 1 2 3 4\n"
      "$EndElements\n";
  const ImportedMesh mesh = read_gmsh_bytes(text, "part.msh");
  ASSERT_EQ(mesh.face_sets.size(), 1u);
  EXPECT_EQ(mesh.face_sets[0].faces.size(), 2u);
  ASSERT_EQ(mesh.node_sets.size(), 2u);
  EXPECT_EQ(mesh.node_sets[0].name, "skin");
  EXPECT_THAT(mesh.node_sets[0].nodes, ElementsAre(0, 1, 2, 3));
}

/// One element of each kind, side by side, with a distinct position for every node.
ImportedMesh one_of_each() {
  ImportedMesh mesh;
  mesh.file = "all.msh";
  mesh.properties = {{"first", fem::PropertyKind::solid, "", {}, 0, {}, {}, {}, {}, false, "", 0},
                     {"second", fem::PropertyKind::solid, "", {}, 0, {}, {}, {}, {}, false, "", 0}};
  std::int64_t id = 100;
  for (const CellKind kind : {CellKind::tet4, CellKind::tet10, CellKind::pyramid5, CellKind::wedge6,
                              CellKind::wedge15, CellKind::hex8, CellKind::hex20}) {
    fem::ImportedBlock block;
    block.kind = kind;
    block.property = id % 2 == 0 ? 0 : 1;
    block.ids = {id};
    for (int k = 0; k < num_nodes(kind); ++k) {
      block.nodes.push_back(mesh.num_nodes());
      mesh.node_ids.push_back(7 + 3 * mesh.num_nodes());
      mesh.positions.emplace_back(static_cast<double>(id), 0.1 * k, k * k / 3.0);
    }
    mesh.blocks.push_back(block);
    ++id;
  }
  mesh.element_sets = {{"first", {0, 2, 4, 6}}, {"second", {1, 3, 5}}, {"some", {1, 2, 6}}};
  fem::ImportedFaceSet faces{"skin", {}};
  int element = 0;
  for (const auto& block : mesh.blocks) {
    fem::ImportedFace face{element++, {}};
    const auto first = fem::cell_faces(block.kind).front();
    for (int k = 0; k < fem::num_corners(first); ++k) {
      face.corners.push_back(
          block.nodes[static_cast<std::size_t>(first[static_cast<std::size_t>(k)])]);
    }
    faces.faces.push_back(face);
  }
  mesh.face_sets = {faces};
  mesh.node_sets = {{"points", {0, 5, 9}}};
  return mesh;
}

template <class Set>
const Set& named(const std::vector<Set>& sets, const std::string& name) {
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const Set& set) { return set.name == name; });
  if (found == sets.end()) throw std::runtime_error("no set " + name);
  return *found;
}

class Formats : public testing::TestWithParam<GmshFormat> {};

TEST_P(Formats, RoundTripsEveryKind) {
  const ImportedMesh mesh = one_of_each();
  const ImportedMesh back = read_gmsh_bytes(gmsh_bytes(mesh, GetParam()), "all.msh");
  EXPECT_EQ(back.node_ids, mesh.node_ids);
  EXPECT_EQ(back.positions, mesh.positions);
  ASSERT_EQ(back.blocks.size(), mesh.blocks.size());
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    EXPECT_EQ(back.blocks[b].kind, mesh.blocks[b].kind);
    EXPECT_EQ(back.blocks[b].ids, mesh.blocks[b].ids);
    EXPECT_EQ(back.blocks[b].nodes, mesh.blocks[b].nodes);
    EXPECT_EQ(back.properties[static_cast<std::size_t>(back.blocks[b].property)].name,
              mesh.properties[static_cast<std::size_t>(mesh.blocks[b].property)].name);
  }
  for (const auto& set : mesh.element_sets) {
    EXPECT_EQ(named(back.element_sets, set.name).elements, set.elements) << set.name;
  }
  EXPECT_EQ(back.element_sets.size(), mesh.element_sets.size());
  const auto& faces = named(back.face_sets, "skin").faces;
  ASSERT_EQ(faces.size(), mesh.face_sets[0].faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    EXPECT_EQ(faces[f].element, mesh.face_sets[0].faces[f].element);
    EXPECT_EQ(faces[f].corners, mesh.face_sets[0].faces[f].corners);
  }
  EXPECT_THAT(named(back.node_sets, "points").nodes, ElementsAre(0, 5, 9));
  // A second conversion adds nothing.
  const ImportedMesh again = read_gmsh_bytes(gmsh_bytes(back, GetParam()), "all.msh");
  ASSERT_EQ(again.node_sets.size(), back.node_sets.size());
  for (const auto& set : back.node_sets) {
    EXPECT_EQ(named(again.node_sets, set.name).nodes, set.nodes) << set.name;
  }
}

/// Every shortened file is refused or, where nothing is missing but the last line's end, read.
TEST_P(Formats, SurvivesEveryTruncation) {
  const std::string bytes = gmsh_bytes(read_gmsh_bytes(kTwo22, "part.msh"), GetParam());
  for (std::size_t size = 0; size + 1 < bytes.size(); ++size) {
    EXPECT_THROW(read_gmsh_bytes(bytes.substr(0, size), "part.msh"), InputError) << size;
  }
}

/// Bytes of which some are wrong give a mesh or a message, nothing else.
TEST_P(Formats, SurvivesWrongBytes) {
  const std::string bytes = gmsh_bytes(one_of_each(), GetParam());
  std::mt19937 engine(20260101);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string wrong = bytes;
    for (int k = 0; k < 3; ++k) {
      wrong[engine() % wrong.size()] = static_cast<char>(engine() % 256);
    }
    try {
      const ImportedMesh mesh = read_gmsh_bytes(wrong, "all.msh");
      for (const auto& block : mesh.blocks) {
        for (const int node : block.nodes) EXPECT_LT(node, mesh.num_nodes());
      }
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("all.msh"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Formats,
                         testing::Values(GmshFormat::ascii_2_2, GmshFormat::binary_2_2,
                                         GmshFormat::ascii_4_1, GmshFormat::binary_4_1));

TEST(GmshMesh, SaysWhatIsWrongAndWhere) {
  const std::string two = kTwo22, four = kTwo41;
  EXPECT_THAT(gmsh_message(""), HasSubstr("the file is empty"));
  EXPECT_EQ(gmsh_message(std::string("\x89PNG\r\n\x1a\n\0\0", 10)),
            "part.msh:1:1: this is not a Gmsh mesh: it does not begin with $MeshFormat");
  EXPECT_THAT(gmsh_message(test::replaced(two, "2.2 0", "3.0 0")), HasSubstr("version 3.0"));
  EXPECT_EQ(gmsh_message(test::replaced(two, "$Nodes\n5", "$Nodes\n6")),
            "part.msh:19:1: expected the number of a node, a whole number, found \"$EndNodes\"");
  EXPECT_THAT(gmsh_message(test::replaced(two, "$Nodes\n5", "$Nodes\n4")),
              HasSubstr("part.msh:18:1: expected $EndNodes"));
  EXPECT_THAT(gmsh_message(test::replaced(two, "$Nodes\n5", "$Nodes\n999999999999")),
              HasSubstr("more than the rest of the file"));
  EXPECT_EQ(gmsh_message(test::replaced(two, "1 1 1.5e0", "1 nan 1")),
            "part.msh:18:6: expected a coordinate of a node, a finite number, found \"nan\"");
  EXPECT_THAT(gmsh_message(test::replaced(two, "20 1 0 0", "10 1 0 0")),
              HasSubstr("node 10 appears"));
  EXPECT_THAT(gmsh_message(test::replaced(two, "20 30 40 50", "20 30 40 77")),
              HasSubstr("part.msh:26:20: element 5 refers to node 77"));
  EXPECT_THAT(gmsh_message(test::replaced(two, "5 4 2 5", "5 94 2 5")), HasSubstr("type 94"));
  const std::string third = gmsh_message(test::replaced(two, "5 4 2 5", "5 29 2 5"));
  EXPECT_THAT(third, HasSubstr("third or higher order (Gmsh's type 29)"));
  EXPECT_THAT(third, HasSubstr("Mesh.ElementOrder = 2"));
  EXPECT_THAT(gmsh_message(test::replaced(two, "5 4 2 5", "4 4 2 5")), HasSubstr("the number 4"));
  EXPECT_THAT(gmsh_message(test::replaced(two, "10 0 0 0", "99999999999999999999 0 0 0")),
              HasSubstr("a whole number"));
  EXPECT_THAT(gmsh_message(test::replaced(four, "2 4 10 40", "2 5 10 40")),
              HasSubstr("has 4 nodes"));
  EXPECT_THAT(gmsh_message(test::replaced(four, "3 1 4 1\n", "2 1 4 1\n")),
              HasSubstr("of dimension 2"));
  EXPECT_THAT(gmsh_message(two + "$Data\n1 2 3\n"), HasSubstr("has no end"));
  EXPECT_THAT(gmsh_message(test::replaced(two, "0 1 \"tip\"", "0 1 \"tip")),
              HasSubstr("closing quotation mark"));
}

TEST(GmshMesh, LeavesOutNodesInTheMiddle) {
  // A quadrangle with nine nodes becomes quad8.
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n";
  for (int k = 1; k <= 9; ++k) text += std::to_string(k) + " 0 0 " + std::to_string(k) + "\n";
  text += "$EndNodes\n$Elements\n1\n1 10 2 0 1 1 2 3 4 5 6 7 8 9\n$EndElements\n";
  const ImportedMesh mesh = read_gmsh_bytes(text, "part.msh");
  EXPECT_EQ(mesh.num_nodes(), 8);
  EXPECT_EQ(mesh.blocks[0].kind, CellKind::quad8);
  EXPECT_EQ(mesh.blocks[0].property, -1);
  EXPECT_EQ(mesh.notes.size(), 1u);
}

}  // namespace
}  // namespace buckens::mesh_io
