// SPDX-License-Identifier: Apache-2.0
// Older versions of the Gmsh format, and files of other programs in that format.
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/mesh_io/gmsh/mesh.h"

namespace buckens::mesh_io {
namespace {

using testing::ElementsAre;

fem::ImportedMesh read_mesh_text(const std::string& text) {
  return read_gmsh_bytes(text, "mesh.msh");
}

template <class T>
std::string bytes(T value) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

/// A tetrahedron in the group "solid" and the triangle below it in group 7.
void expect_tetrahedron(const fem::ImportedMesh& mesh, const std::string& group) {
  EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(mesh.positions.at(3), Eigen::Vector3d(0, 0, 1));
  ASSERT_EQ(mesh.num_elements(), 1);
  EXPECT_THAT(mesh.blocks.at(0).nodes, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(mesh.properties.at(0).name, group);
  EXPECT_EQ(mesh.face_sets.size(), 1u);
}

TEST(GmshVersions, one) {
  const auto mesh = read_mesh_text(
      "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n"
      "$ELM\n2\n1 2 7 1 3 1 3 2\n2 4 8 1 4 1 2 3 4\n$ENDELM\n");
  EXPECT_EQ(mesh.format, "Gmsh 1.0 text");
  expect_tetrahedron(mesh, "volume_8");
}

TEST(GmshVersions, two_with_names_without_dimension_and_comments) {
  for (const char* version : {"2", "2.0", "2.1"}) {
    const auto mesh = read_mesh_text(
        std::string("$Comments\nby hand\n$EndComments\n$MeshFormat\n") + version +
        " 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n8\"solid\"\n"  // as in some of Elmer
        "-1 7 \"floor\" of another program\n$EndPhysicalNames\n"
        "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
        "$Elements\n2\n1 2 2 7 1 1 3 2\n2 4 2 8 1 1 2 3 4\n$EndElements\n");
    expect_tetrahedron(mesh, "solid");
    EXPECT_EQ(mesh.face_sets.at(0).name, "floor");
  }
}

constexpr char kEntities40[] =
    "$MeshFormat\n4 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 8 \"solid\"\n$EndPhysicalNames\n"
    "$Entities\n1 0 1 1\n1 0 0 0 0 0 0 0\n2 0 0 0 1 1 0 1 7 0\n3 0 0 0 1 1 1 1 8 1 "
    "2\n$EndEntities\n";

TEST(GmshVersions, four_point_zero) {
  const auto mesh =
      read_mesh_text(std::string(kEntities40) +
                     "$Nodes\n2 4\n1 0 0 1\n1 0 0 0\n2 2 1 3\n2 1 0 0 0.5 0.5\n3 0 1 0 1 2\n"
                     "4 0 0 1 3 4\n$EndNodes\n"
                     "$Elements\n2 2\n2 2 2 1\n1 1 3 2\n3 3 4 1\n2 1 2 3 4\n$EndElements\n");
  EXPECT_EQ(mesh.format, "Gmsh 4.0 text");
  expect_tetrahedron(mesh, "solid");
}

TEST(GmshVersions, four_point_zero_in_binary) {
  using Long = std::uint64_t;
  std::string text = "$MeshFormat\n4 1 8\n" + bytes(1) + "\n$EndMeshFormat\n$Entities\n";
  for (const Long count : {0, 0, 1, 1}) text += bytes(count);
  for (const int entity : {2, 3}) {
    text += bytes(entity);
    for (int k = 0; k < 6; ++k) text += bytes(0.0);
    text += bytes(Long{1}) + bytes(entity + 5) + bytes(Long{0});
  }
  text += "\n$EndEntities\n$Nodes\n" + bytes(Long{1}) + bytes(Long{4}) + bytes(3) + bytes(3) +
          bytes(0) + bytes(Long{4});
  const double positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 4; ++i) {
    text += bytes(i + 1);
    for (const double x : positions[i]) text += bytes(x);
  }
  text += "\n$EndNodes\n$Elements\n" + bytes(Long{2}) + bytes(Long{2});
  for (const int value : {2, 2, 2}) text += bytes(value);
  text += bytes(Long{1});
  for (const int value : {1, 1, 3, 2, 3, 3, 4}) text += bytes(value);
  text += bytes(Long{1});
  for (const int value : {2, 1, 2, 3, 4}) text += bytes(value);
  expect_tetrahedron(read_mesh_text(text + "\n$EndElements\n"), "volume_8");
}

TEST(GmshVersions, parts_of_a_divided_mesh_keep_their_groups) {
  const auto mesh = read_mesh_text(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 8 \"solid\"\n$EndPhysicalNames\n"
      "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 8 0\n$EndEntities\n"
      "$PartitionedEntities\n2\n1\n9 2\n1 0 0 2\n5 3 1 1 1 0 0 0 0\n"
      "2 3 1 1 1 0 0 0 1 1 1 1 8 0\n3 3 1 2 1 2 0 0 0 1 1 1 1 8 0\n$EndPartitionedEntities\n"
      "$Nodes\n1 5 1 5\n3 2 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
      "$Elements\n2 2 1 2\n3 2 4 1\n1 1 2 3 4\n3 3 4 1\n2 2 3 4 5\n$EndElements\n");
  ASSERT_EQ(mesh.num_elements(), 2);
  ASSERT_EQ(mesh.properties.size(), 1u);
  EXPECT_EQ(mesh.properties[0].name, "solid");
}

/// As fTetWild writes it: no line ends behind binary data, no groups, and a field.
TEST(GmshVersions, marks_may_follow_binary_data_directly) {
  std::string text = "$MeshFormat\n2.2 1 8\n" + bytes(1) + "$EndMeshFormat\n$Nodes\n4\n";
  const double positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 4; ++i) {
    text += bytes(i + 1);
    for (const double x : positions[i]) text += bytes(x);
  }
  text += "$EndNodes\n$Elements\n1\n";
  for (const int value : {4, 1, 0, 1, 1, 2, 3, 4}) text += bytes(value);
  text += "$EndElements\n$ElementData\n1\n\"color\"\n1\n0.0\n3\n0\n1\n1\n" + bytes(1) + bytes(0.5);
  EXPECT_EQ(read_mesh_text(text + "$EndElementData\n").num_elements(), 1);
}

TEST(GmshVersions, groups_without_members) {
  const auto mesh = read_mesh_text(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 8 \"solid\"\n2 9 \"empty\"\n"
      "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
      "$Elements\n1\n2 4 2 8 1 1 2 3 4\n$EndElements\n");
  EXPECT_EQ(mesh.num_elements(), 1);
  // Universal files of Salome: an empty group between others, and its empty line.
  const auto salome = read_gmsh_bytes(
      "    -1\n  2411\n 1 1 1 11\n 0 0 0\n 2 1 1 11\n 1 0 0\n 3 1 1 11\n 0 1 0\n 4 1 1 11\n 0 0 1\n"
      "    -1\n    -1\n  2412\n 1 111 1 1 7 4\n 1 2 3 4\n    -1\n"
      "    -1\n  2467\n 1 0 0 0 0 0 0 0\nempty\n\n 2 0 0 0 0 0 0 1\nsolid\n 8 1 0 0\n    -1\n",
      "mesh.unv");
  EXPECT_EQ(salome.properties.at(0).name, "solid");
}

}  // namespace
}  // namespace buckens::mesh_io
