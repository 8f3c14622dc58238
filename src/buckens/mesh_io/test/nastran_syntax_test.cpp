// SPDX-License-Identifier: Apache-2.0
// Ways of writing a deck: repeated lines, scattered continuations, long lines, NASTRAN-95.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/mesh_io/nastran/number.h"
#include "buckens/mesh_io/test/nastran_sample.h"

namespace buckens::mesh_io {
namespace {

using Eigen::Vector3d;
using test::has_note;
using test::kTetra;
using test::read_deck;
using testing::ElementsAre;

TEST(NastranSyntax, lines_repeat_the_line_before) {
  const auto mesh = read_deck(
      "GRID,1,,0.,5.,7.\n"
      "=,*(1),=,*(.5),==\n"
      "=2\n"
      "GRID,10,,1.\n"
      "=(3),*(2),,%(4.)\n"
      "GRID    20              1.      2.      3.\n"
      "=       21      =       =       8.\n");
  EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4, 10, 12, 14, 16, 20, 21));
  // Sums and steps of numbers with few binary digits are exact.
  EXPECT_EQ(mesh.positions[3], Vector3d(1.5, 5, 7));
  EXPECT_EQ(mesh.positions[6], Vector3d(3, 0, 0));
  EXPECT_EQ(mesh.positions[7], Vector3d(4, 0, 0));
  EXPECT_EQ(mesh.positions[9], Vector3d(1, 8, 0));
}

TEST(NastranSyntax, a_slash_adds_what_the_field_before_adds) {
  std::string deck;
  for (int i = 1; i <= 8; ++i) {
    deck += "GRID," + std::to_string(i) + ",," + std::to_string(i) + ".," + std::to_string(i * i) +
            "." + "," + std::to_string(i * i * i) + ".\n";
  }
  for (const std::string slashes : {"/,/,/", "///", "//,/"}) {
    const auto mesh = read_deck(deck + "CTETRA,1,1,1,2,3,4\n=(1),*(1),=,*(4)," + slashes + "\n");
    EXPECT_THAT(mesh.blocks.at(0).nodes, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7)) << slashes;
    EXPECT_THAT(mesh.blocks.at(0).ids, ElementsAre(1, 2));
  }
}

TEST(NastranSyntax, continuations_repeat_the_rest_of_the_line_before) {
  const auto mesh = read_deck(
      "GRID,1\nGRID,2,,1.\nMAT1,1,1.,,.3\n"
      "PBAR,1,1,1.,1.,1.,1.,,,+P1\n"
      "PBAR,2,1,2.,2.,2.,2.,,,+P2\n"
      "PBAR,3,1,3.,3.,3.,3.,,,+P3\n"
      "CBAR,1,1,1,2,0.,0.,1.\nCBAR,2,2,1,2,0.,0.,1.\nCBAR,3,3,1,2,0.,0.,1.\n"
      "+P1,.125,0.,.5,.75\n"
      "+P2,==\n"
      "+P3,2.,==\n");
  const auto points = [&](std::size_t property) {
    return std::get<fem::GeneralSectionSpec>(mesh.properties.at(property).section->shape)
        .stress_points;
  };
  EXPECT_EQ(points(1), points(0));
  EXPECT_THAT(points(2).at(0), ElementsAre(2.0, 0.0));
  EXPECT_THAT(points(2).at(1), ElementsAre(0.5, 0.75));
  // Nothing to repeat: what stands there is named.
  test::expect_words(test::refusal("+A,==\n"), {"continues a card", "none before"});
}

TEST(NastranSyntax, continuations_stand_anywhere_behind_their_card) {
  const std::string nodes = "GRID,1\nGRID,2,,1.\nMAT1,1,1.,,.3\n";
  const auto mesh = read_deck(nodes +
                              "PBAR,1,1,1.,1.,1.,1.,,,+P1\n"
                              "=,2,=,2.,2.,2.,2.,,,+P2\n"
                              "CBAR,1,1,1,2,0.,0.,1.\nCBAR,2,2,1,2,0.,0.,1.\n"
                              "+P2,.5,.25\n"
                              "+P1,.125,0.\n");
  using General = fem::GeneralSectionSpec;
  const auto point = [&](std::size_t property) {
    return std::get<General>(mesh.properties.at(property).section->shape).stress_points.at(0);
  };
  EXPECT_THAT(point(0), ElementsAre(0.125, 0.0));
  EXPECT_THAT(point(1), ElementsAre(0.5, 0.25));
}

TEST(NastranSyntax, the_first_character_of_a_mark_may_be_any) {
  const std::string row =
      "PBAR    1       1       1.      1.      1.      1.                      C";
  const auto mesh = read_deck("GRID,1\nGRID,2,,1.\nMAT1,1,1.,,.3\nCBAR,1,1,1,2,0.,0.,1.\n" + row +
                              "AB\n+AB     .5      .5\n");
  const auto section = std::get<fem::GeneralSectionSpec>(mesh.properties.at(0).section->shape);
  EXPECT_EQ(section.stress_points.size(), 4u);
}

TEST(NastranSyntax, long_free_lines_go_on) {
  const auto mesh = read_deck(
      "CORD2R,1,0,0.,0.,0.,0.,0.,1.,0.,1.,0.\nGRID,1,1,2.\n"
      "SPC1,1,123,1,2,3,4,5,6,7,8,9,10\n"
      "GRID,2,,1.  2. 3.\n"
      "GRID,3,4)7.\n");
  // The system's x axis is the basic y axis.
  EXPECT_LT((mesh.positions.at(0) - Vector3d(0, 2, 0)).norm(), 1e-15);
  EXPECT_EQ(mesh.positions.at(1), Vector3d(1, 2, 3));
  EXPECT_EQ(mesh.positions.at(2), Vector3d(7, 0, 0));
}

TEST(NastranSyntax, texts_are_passed_over) {
  const auto mesh = read_deck(kTetra +
                              "DEQATN  5       F(A,B) = A*B+\n        C(1,2)-=3\n+       D\n"
                              "BSURF,1,1050,1133,1146,\n1054,1002\n"
                              "ADAPT,101,,,210,220\n        part=ALL,elset=501\n"
                              "/       9       10\n"
                              "PLOTEL,1,2,3\nPLOTEL,2,2,3\n");
  EXPECT_EQ(mesh.num_elements(), 1);
  for (const char* card : {"DEQATN", "BSURF", "ADAPT", "/: ", "PLOTEL"}) {
    EXPECT_TRUE(has_note(mesh, card)) << card;
  }
}

TEST(NastranSyntax, a_dmap_program_begins_before_the_bulk_data) {
  const auto mesh = read_deck("APP DMAP\nBEGIN $\nINPUTT4 /A $\nEND $\nCEND\nBEGIN BULK\n" +
                              kTetra + "ENDDATA\n");
  EXPECT_EQ(mesh.num_elements(), 1);
}

TEST(NastranSyntax, blanks_before_an_exponent) {
  EXPECT_EQ(nastran_real("20.0 E+7"), 2e8);
  EXPECT_EQ(nastran_real(".50  E+6"), 5e5);
  EXPECT_EQ(nastran_real("10.4  +6"), 1.04e7);
  EXPECT_FALSE(nastran_real("20.0 7").has_value());
}

TEST(NastranSyntax, elements_of_nastran_95) {
  std::string deck = "MAT1,3,1.,,.3,2.\nPQUAD2,1,3,.5\nPTRIA2,1,3,.25\n";
  for (int i = 0; i < 8; ++i) {
    deck += "GRID," + std::to_string(i + 1) + ",," + std::to_string((i + 1) / 2 % 2) + ".," +
            std::to_string(i / 2 % 2) + ".," + std::to_string(i / 4) + ".\n";
  }
  const auto mesh = read_deck(deck +
                              "CQUAD2,1,1,1,2,3,4\nCTRIA2,2,1,1,2,3\n"
                              "CHEXA1,3,3,1,2,3,4,5,6\n,7,8\n"
                              "CTETRA,4,3,1,2,4,5\n");
  // Each card of NASTRAN-95 has numbers of its own; solids of one material are one property.
  ASSERT_EQ(mesh.properties.size(), 3u);
  EXPECT_EQ(mesh.properties[0].thickness.value_or(0), 0.5);
  EXPECT_EQ(mesh.properties[1].thickness.value_or(0), 0.25);
  EXPECT_EQ(mesh.properties[2].material, "MAT1 3");
  EXPECT_TRUE(has_note(mesh, "CQUAD2: taken as CQUAD4"));
}

TEST(NastranSyntax, two_short_elements_on_one_card) {
  const auto mesh = read_deck(kTetra +
                              "PROD,5,1,1.\nCROD,11,5,1,2,12,5,2,3\nCONM2,9,1,,1.\n"
                              "CELAS2,20,6.,1,3,101,0\n"
                              "CELAS4,21,6.,101,102,22,6.,102,103\n"
                              "CELAS2,23,6.,103,,4,3\nSPOINT,101,102,103\n");
  EXPECT_THAT(mesh.blocks.at(1).ids, ElementsAre(11, 12));
  EXPECT_THAT(mesh.blocks[1].nodes, ElementsAre(0, 1, 1, 2));
  // Four springs of 6 in a row.
  ASSERT_EQ(mesh.springs.size(), 1u);
  EXPECT_NEAR(mesh.springs[0].stiffness(2, 2), 1.5, 1e-14);
}

TEST(NastranSyntax, defaults_of_beams) {
  const std::string nodes =
      "GRID,1\nGRID,2,,1.\nGRID,3,,0.,1.\nMAT1,1,1.,,.3\n"
      "PBAR,7,1,1.,1.,1.,1.\nPBEAM,8,1,1.,1.,1.,,1.\n";
  // They may come behind the elements.
  const auto mesh = read_deck(nodes +
                              "CBAR,1,,1,2\nCBEAM,2,,1,2\nCBAR,3,,1,2,0.,0.,1.\n"
                              "BAROR,,7,,,3,,,2\nBEAMOR,,8,,,0.,0.,1.\n");
  ASSERT_EQ(mesh.blocks.size(), 2u);
  EXPECT_EQ(mesh.properties[0].name, "PBAR 7");
  EXPECT_EQ(mesh.properties[1].name, "PBEAM 8");
  // G0 lies along y, so that the section's z axis is z; with v along z it is -y.
  EXPECT_LT((mesh.blocks[0].up[0] - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((mesh.blocks[0].up[1] + Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((mesh.blocks[1].up[0] + Vector3d::UnitY()).norm(), 1e-15);
}

}  // namespace
}  // namespace buckens::mesh_io
