// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/test/replaced.h"

namespace buckens::mesh_io {
namespace {

using fem::ImportedMesh;
using testing::ElementsAre;
using testing::HasSubstr;

/// A parabolic tetrahedron, a triangle on it, and groups of both and of a node.
constexpr char kPart[] = R"(    -1
   164
         2mm (milli-newton)           2
    1.0000000000000000D+03    1.0000000000000000D+03    1.0000000000000000D+00
    2.7314999999999998D+02
    -1
    -1
  2411
         1         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
         2         1         1        11
   2.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
         3         1         1        11
   0.0000000000000000D+00   2.0000000000000000D+00   0.0000000000000000D+00
         4         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   2.0000000000000000D+00
        12         1         1        11
   1.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
        23         1         1        11
   1.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00
        13         1         1        11
   0.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00
        14         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   1.0000000000000000D+00
        24         1         1        11
   1.0000000000000000D+00   0.0000000000000000D+00   1.0000000000000000D+00
        34         1         1        11
   0.0000000000000000D+00   1.0000000000000000D+00   1.0000000000000000D+00
    -1
    -1
  2412
         7       118         1         1         7        10
         1        12         2        23         3        13        14        24
        34         4
         8        92         1         1         7         6
         1        13         3        23         2        12
    -1
    -1
  2467
         1         0         0         0         0         0         0         1
body
         8         7         0         0
         2         0         0         0         0         0         0         2
ground
         8         8         0         0         7         4         0         0
    -1
)";

std::string universal_message(const std::string& text) {
  try {
    read_gmsh_bytes(text, "part.unv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(UniversalFile, ReadsNodesElementsAndGroups) {
  const ImportedMesh mesh = read_gmsh_bytes(kPart, "part.unv");
  ASSERT_EQ(mesh.num_elements(), 1);
  EXPECT_EQ(mesh.blocks[0].kind, fem::CellKind::tet10);
  // Corners first, then the edges 01, 12, 20, 03, 13, 23.
  std::vector<std::int64_t> ids;
  for (const int node : mesh.blocks[0].nodes) {
    ids.push_back(mesh.node_ids[static_cast<std::size_t>(node)]);
  }
  EXPECT_THAT(ids, ElementsAre(1, 2, 3, 4, 12, 23, 13, 14, 24, 34));
  EXPECT_EQ(mesh.properties[0].name, "body");
  EXPECT_EQ(mesh.face_sets[0].name, "ground");
  EXPECT_EQ(mesh.face_sets[0].faces.size(), 1u);
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_THAT(mesh.notes[0].text, HasSubstr("1 m is 1000 of its length units"));
}

TEST(UniversalFile, IsKnownByItsEndingInAnyLetters) {
  for (const char* name : {"part.unv", "PART.UNV", "Part.Unv"}) {
    EXPECT_EQ(read_gmsh_bytes(kPart, name).num_elements(), 1) << name;
  }
}

TEST(UniversalFile, LeavesOutMembersThatAreNotThere) {
  const ImportedMesh mesh = read_gmsh_bytes(
      test::replaced(kPart, "         8         7         0", "         8        70         0"),
      "part.unv");
  EXPECT_TRUE(mesh.properties.empty());
  EXPECT_THAT(mesh.notes.back().text, HasSubstr("members of groups"));
}

TEST(UniversalFile, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(universal_message("hello\n"), HasSubstr("part.unv:1:1: expected -1"));
  EXPECT_THAT(universal_message("    -1\n  2412\n    -1\n"), HasSubstr("no nodes"));
  EXPECT_THAT(
      universal_message(test::replaced(kPart, "        34         4\n", "        35         4\n")),
      HasSubstr("element 7 refers to node 35"));
  EXPECT_THAT(universal_message(test::replaced(kPart, "       118 ", "       999 ")),
              HasSubstr("the descriptor 999"));
  EXPECT_THAT(
      universal_message(test::replaced(kPart, "         7        10\n", "         7         4\n")),
      HasSubstr("has 4 nodes; expected 10"));
  EXPECT_THAT(
      universal_message(test::replaced(kPart, "2.0000000000000000D+00", "                   inf")),
      HasSubstr("part.unv:12:"));
}

/// Three nodes on a line, then these elements and groups.
std::string line_of(const std::string& elements, const std::string& groups = "") {
  std::string text = "    -1\n  2411\n";
  for (int k = 1; k <= 3; ++k) {
    text += std::to_string(k) + " 1 1 11\n" + std::to_string(k) + ".0D+00 0.0D+00 0.0D+00\n";
  }
  text += "    -1\n    -1\n  2412\n" + elements + "    -1\n";
  return groups.empty() ? text : text + "    -1\n  2467\n" + groups + "    -1\n";
}

TEST(UniversalFile, NodesOfVibrationTestsAndFunctionsInBytes) {
  // Data set 15 has a node on one line; 58b is followed by bytes, which may look like lines.
  const std::string bytes("\x01\n-1\n\0\xff", 7);
  const ImportedMesh mesh = read_gmsh_bytes(
      "    -1\n    58b     1     2          11\nNONE\n" + bytes +
          "\n    -1\n    -1\n    15\n         3         1         0         1  3.65000E+01"
          " -6.32200E+01 -5.00000E+01\n         4         1         0         1  1.0E+00  0.0  "
          "0.0\n"
          "    -1\n    -1\n  2412\n7 11 1 1 7 2\n3 4\n    -1\n",
      "part.unv");
  ASSERT_EQ(mesh.positions.size(), 2u);
  EXPECT_EQ(mesh.positions[0], Eigen::Vector3d(36.5, -63.22, -50));
  EXPECT_EQ(mesh.num_elements(), 1);
  EXPECT_THAT(mesh.notes.at(0).text, HasSubstr("58b is ignored"));
  EXPECT_THAT(universal_message("    -1\n   58b  1  2\nNONE\n"), HasSubstr("58b has no end"));
}

TEST(UniversalFile, WhatHasNoShapeIsLeftOutAndCounted) {
  const ImportedMesh mesh =
      read_gmsh_bytes(line_of("7 11 1 1 7 2\n1 3\n8 161 3 1 1 1\n2\n9 161 3 1 1 1\n3\n"
                              "10 122 4 1 1 3\n1 2 3\n"),
                      "part.unv");
  EXPECT_EQ(mesh.num_elements(), 1);
  ASSERT_EQ(mesh.notes.size(), 2u);
  EXPECT_THAT(mesh.notes[0].text, HasSubstr("lumped masses are left out"));
  EXPECT_EQ(mesh.notes[0].count, 2);
  EXPECT_TRUE(mesh.notes[0].is_doubtful);
  EXPECT_THAT(mesh.notes[1].text, HasSubstr("rigid elements"));
}

TEST(UniversalFile, RodsMayHaveTheRecordOfBeams) {
  // Salome writes it, the format has it for beams only.
  for (const char* rod : {"7 11 1 1 7 2\n0 1 1\n1 3\n", "7 11 1 1 7 2\n1 3\n"}) {
    const ImportedMesh mesh = read_gmsh_bytes(line_of(rod), "part.unv");
    ASSERT_EQ(mesh.num_elements(), 1) << rod;
    EXPECT_EQ(mesh.blocks[0].kind, fem::CellKind::line2);
    EXPECT_THAT(mesh.blocks[0].nodes, ElementsAre(0, 2)) << rod;
  }
}

TEST(UniversalFile, EdgesOfSalomeMayHaveANodeInTheirMiddle) {
  for (const char* descriptor : {"22", "24"}) {
    const ImportedMesh mesh = read_gmsh_bytes(
        line_of(std::string("7 ") + descriptor + " 1 1 7 3\n0 1 1\n1 2 3\n"), "part.unv");
    ASSERT_EQ(mesh.num_elements(), 1);
    EXPECT_EQ(mesh.blocks[0].kind, fem::CellKind::line3);
    EXPECT_THAT(mesh.blocks[0].nodes, ElementsAre(0, 2, 1));  // ends first
  }
}

TEST(UniversalFile, GroupsMayBeEmpty) {
  const std::string beams = "7 21 1 1 7 2\n0 1 1\n1 2\n8 21 1 1 7 2\n0 1 1\n2 3\n";
  const ImportedMesh mesh =
      read_gmsh_bytes(line_of(beams,
                              "1 0 0 0 0 0 0 0\nnothing\n2 0 0 0 0 0 0 1\nfirst\n8 7 0 0\n"
                              "3 0 0 0 0 0 0 0\nnothing either\n"),
                      "part.unv");
  ASSERT_EQ(mesh.element_sets.size(), 1u);
  EXPECT_EQ(mesh.element_sets[0].name, "first");
  EXPECT_EQ(mesh.element_sets[0].elements.size(), 1u);
}

TEST(UniversalFile, ElementsBetweenTheSameNodesAreSeveral) {
  const ImportedMesh mesh =
      read_gmsh_bytes(line_of("7 21 1 1 7 2\n0 1 1\n1 2\n8 21 1 1 7 2\n0 1 1\n1 2\n"), "part.unv");
  EXPECT_EQ(mesh.num_elements(), 2);
}

TEST(UniversalFile, SurvivesEveryTruncation) {
  const std::string text = kPart;
  const std::size_t groups = text.find("  2467");
  for (std::size_t size = 0; size + 1 < groups; ++size) {
    try {
      read_gmsh_bytes(text.substr(0, size), "part.unv");
      // What is left may be complete by itself, without the groups.
      EXPECT_GT(size, groups - 20) << size;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("part.unv"));
    }
  }
}

}  // namespace
}  // namespace buckens::mesh_io
