// SPDX-License-Identifier: Apache-2.0
// How lines become cards and fields numbers, and cards whose variants the large deck lacks.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/fem/mesh/report.h"
#include "buckens/mesh_io/nastran/number.h"
#include "buckens/mesh_io/test/nastran_sample.h"

namespace buckens::mesh_io {
namespace {

using Eigen::Vector3d;
using test::has_note;
using test::kTetra;
using test::read_deck;

TEST(NastranNumber, all_ways_to_write_a_real) {
  for (const char* text :
       {"1500.", "1.5+3", "1.5E3", "1.5e+3", "1.5D3", ".15+4", "+1500.0", "15.d2", "1500"}) {
    EXPECT_EQ(nastran_real(text), 1500.0) << text;
  }
  EXPECT_EQ(nastran_real("1.-3"), 1e-3);
  EXPECT_EQ(nastran_real("-1.-3"), -1e-3);
  EXPECT_EQ(nastran_real("1.-400"), 0.0);
  for (const char* text : {"", ".", "-", "+", "nan", "inf", "-inf", "0x10", "1.0.0", "1e", "1.+",
                           "1 2", "1,5", "1.E5.", "1.+400", "++1.", "1.0f"}) {
    EXPECT_FALSE(nastran_real(text).has_value()) << text;
  }
  EXPECT_EQ(nastran_integer("+12"), 12);
  EXPECT_FALSE(nastran_integer("1.").has_value());
  EXPECT_FALSE(nastran_integer("99999999999999999999").has_value());
}

TEST(NastranCards, tabs_and_lower_case_and_comments_and_line_ends) {
  const auto mesh = read_deck(
      "$ a comment\r\n"
      "grid\t1\t\t1.\t2.\t3.\r\n"
      "Grid*\t2\t\t\t\t4.\t\t5.\r\n"
      "*\t6.\r\n"
      "\r\n"
      "GRID    3               7.      8.      9.      $ behind\r\n");
  ASSERT_EQ(mesh.num_nodes(), 3);
  EXPECT_EQ(mesh.positions[0], Vector3d(1, 2, 3));
  EXPECT_EQ(mesh.positions[1], Vector3d(4, 5, 6));
  EXPECT_EQ(mesh.positions[2], Vector3d(7, 8, 9));
}

TEST(NastranCards, continuations_by_mark_by_plus_and_by_blank) {
  for (const char* second : {"+A      7       8\n", "+       7       8\n", "        7       8\n",
                             ",7,8\n", "+A,7,8\n", "*A                     7               8\n"}) {
    std::string deck;
    for (int i = 1; i <= 8; ++i) {
      deck += "GRID," + std::to_string(i) + ",," + std::to_string(i % 2) + ".," +
              std::to_string(i / 2 % 2) + "." + "," + std::to_string(i / 4 % 2) + ".\n";
    }
    deck += "CHEXA   1       1       1       2       3       4       5       6       +A\n";
    deck += second;
    deck += "PSOLID,1,1\nMAT1,1,1.,,.3\n";
    const auto mesh = read_deck(deck);
    ASSERT_EQ(mesh.blocks.size(), 1u) << second;
    EXPECT_THAT(mesh.blocks[0].nodes, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7)) << second;
  }
}

TEST(NastranCards, a_deck_may_be_bulk_data_alone_or_have_control_sections) {
  EXPECT_EQ(read_deck(kTetra).num_elements(), 1);
  const auto mesh = read_deck("SOL 101\nCEND\nBEGIN BULK\n" + kTetra + "ENDDATA\nrubbish\n");
  EXPECT_EQ(mesh.num_elements(), 1);
  EXPECT_TRUE(has_note(mesh, "executive and case control, 2 lines"));
  EXPECT_FALSE(has_note(mesh, "ENDDATA is missing"));
  EXPECT_TRUE(has_note(read_deck("SOL 101\nCEND\nBEGIN BULK\n" + kTetra), "ENDDATA is missing"));
}

TEST(NastranCards, sets_of_the_case_control_that_hold_no_numbers_are_passed_over) {
  for (const char* set : {"SET 9 = THRU 8 EXCEPT 5, 21", "SET 9 = 1.5, 2", "SET 9 = 1 THRU",
                          "SET 9 = ALL", "SET 9 = EXCEPT 1 THRU"}) {
    const auto mesh = read_deck(std::string(set) + "\nBEGIN BULK\n" + kTetra + "ENDDATA\n");
    EXPECT_TRUE(mesh.node_sets.empty()) << set;
  }
}

TEST(NastranCards, weights_become_masses) {
  const auto mesh = read_deck(kTetra + "CONM2,5,1,,2.,,,,,\n,3.,,3.,,,3.\nPARAM,WTMASS,.5\n");
  EXPECT_EQ(mesh.materials.at(0).rho, 0.5 * 7850);
  EXPECT_EQ(mesh.masses.at(0).mass, 1.0);
  EXPECT_EQ(mesh.masses.at(0).inertia(1, 1), 1.5);
}

TEST(NastranCards, nodes_have_defaults) {
  const auto mesh = read_deck("GRDSET,,1\nCORD2R,1,,5.,0.,0.,5.,0.,1.\n,6.,0.,0.\n" + kTetra +
                              "GRID,9,0,1.,1.,1.\n");
  EXPECT_EQ(mesh.positions[0], Vector3d(5, 0, 0));
  EXPECT_EQ(mesh.positions[4], Vector3d(1, 1, 1));
}

TEST(NastranCards, twice_the_same_node_is_one) {
  const auto mesh = read_deck(kTetra + "GRID,1,,0.,0.,0.\n");
  EXPECT_EQ(mesh.num_nodes(), 4);
  EXPECT_TRUE(has_note(mesh, "repeated"));
}

TEST(NastranCards, nonstructural_mass_goes_to_the_nodes) {
  const auto mesh = read_deck(kTetra +
                              "PSHELL,2,1,.1,1,,,,6.\nCTRIA3,2,2,1,2,3\n"
                              "PROD,3,1,1.,,,4.\nCROD,3,3,1,2\n");
  double sum = 0;
  for (const auto& mass : mesh.masses) sum += mass.mass;
  EXPECT_NEAR(sum, 0.5 * 6 + 1 * 4, 1e-14);
  EXPECT_EQ(mesh.masses.size(), 3u);
}

TEST(NastranCards, shells_with_mid_side_nodes) {
  std::string nodes = "MAT1,1,1.,,.3\nPSHELL,1,1,.1,1,,,,3.\nPSHELL,2,1,.1,1\n";
  const char* const places[] = {"0.,0.", "2.,0.", "2.,2.", "0.,2.", "1.,0.",
                                "2.,1.", "1.,2.", "0.,1.", "1.,1."};
  for (int i = 0; i < 9; ++i) nodes += "GRID," + std::to_string(i + 1) + ",," + places[i] + "\n";
  const auto mesh = read_deck(nodes +
                              "CQUAD8,1,1,1,2,3,4,5,6\n,7,8\n"
                              "CTRIA6,2,2,1,2,3,5,6,9\n,30.,.5,.2,.2,.2\n"
                              "CQUAD8,3,2,1,2,3,4\n");
  ASSERT_EQ(mesh.blocks.size(), 3u);
  EXPECT_EQ(mesh.blocks[0].kind, fem::CellKind::quad8);
  EXPECT_THAT(mesh.blocks[0].nodes, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(mesh.blocks[1].kind, fem::CellKind::tri6);
  EXPECT_THAT(mesh.blocks[1].nodes, testing::ElementsAre(0, 1, 2, 4, 5, 8));
  EXPECT_NEAR(mesh.properties.at(1).thickness.value_or(0), 0.2, 1e-15);
  EXPECT_EQ(mesh.properties[1].offset, 0.5);
  EXPECT_EQ(mesh.blocks[2].kind, fem::CellKind::quad4);
  double nonstructural = 0;
  for (const auto& mass : mesh.masses) nonstructural += mass.mass;
  EXPECT_NEAR(nonstructural, 3 * 4, 1e-14);
}

TEST(NastranCards, thickness_at_corners_is_averaged) {
  const auto mesh = read_deck(kTetra +
                              "PSHELL,2,1,.1,1\nCTRIA3,2,2,1,2,3\n,,,.1,.2,.3\n"
                              "CTRIA3,3,2,1,2,4\n,,1,3.,3.,3.\n");
  EXPECT_NEAR(mesh.properties.at(1).thickness.value_or(0), 0.2, 1e-15);
  EXPECT_NEAR(mesh.properties.at(2).thickness.value_or(0), 0.3, 1e-15);
  EXPECT_TRUE(has_note(mesh, "mean"));
}

TEST(NastranCards, thickness_at_corners_keeps_the_mass) {
  // t = 0.1 + 0.1 x over the trapezium 0 ≤ x ≤ 2 − y, 0 ≤ y ≤ 1; T1 and T4 are blank.
  const auto mesh = read_deck(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
      "MAT1,1,1.,,.3\nPSHELL,2,1,.1,1\nCQUAD4,2,2,1,2,3,4\n,,,,.3,.2\n"
      "CQUAD4,3,2,1,2,3,4\n,,,.1,.1005,.1\n");
  // ∫₀¹ (0.1 (2 − y) + 0.05 (2 − y)²) dy = 0.15 + 0.05 · 7/3, over an area of 1.5.
  EXPECT_NEAR(mesh.properties.at(0).thickness.value_or(0), (0.15 + 0.35 / 3) / 1.5, 1e-15);
  for (const fem::ImportNote& note : mesh.notes) {
    if (note.text.find("mean") != std::string::npos) {
      EXPECT_EQ(note.count, 1) << "half a percent is not worth a note";
    }
  }
}

TEST(NastranCards, a_system_along_the_normal_gives_isotropic_layers_no_direction) {
  const std::string deck =
      kTetra +
      "CORD2R,7,,0.,0.,0.,1.,0.,0.\n,0.,0.,1.\nPCOMP,2\n,{},.1,0.\nCTRIA3,2,2,1,2,3,7\n"
      "MAT8,2,1.+5,1.+4,.3,5.+3\n";
  const auto with = [&](const std::string& material) {
    std::string text = deck;
    text.replace(text.find("{}"), 2, material);
    return text;
  };
  const auto mesh = read_deck(with("1"));
  EXPECT_FALSE(mesh.properties.at(1).axes.has_value());
  EXPECT_TRUE(has_note(mesh, "MCID along the normal"));
  test::expect_words(test::refusal(with("2")),
                     {"deck.bdf:12:1", "CTRIA3 2", "MCID 7", "parallel to its normal"});
}

TEST(NastranCards, nonstructural_mass_by_cards_of_its_own) {
  // Two squares of one unit, a rod of length 2 and a bar of length 1.
  const std::string deck =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,2.,0.,0.\n"
      "GRID,6,,2.,1.,0.\nMAT1,1,1.,,.3\nPSHELL,2,1,.1,1\nPSHELL,3,1,.1,1\nPROD,4,1,.1\n"
      "PBAR,5,1,1.,1.,1.,1.\nCQUAD4,2,2,1,2,3,4\nCQUAD4,3,3,2,5,6,3\nCROD,4,4,1,5\n"
      "CBAR,5,5,4,3,0.,0.,1.\n";
  const auto total = [](const fem::ImportedMesh& mesh) {
    double out = 0;
    for (const auto& mass : mesh.masses) out += mass.mass;
    return out;
  };
  EXPECT_NEAR(total(read_deck(deck + "NSM,9,PSHELL,2,5.,3,7.\n")), 12, 1e-14);
  EXPECT_NEAR(total(read_deck(deck + "NSM1,9,PSHELL,5.,2,THRU,3\n")), 10, 1e-14);
  EXPECT_NEAR(total(read_deck(deck + "NSM1,9,PROD,5.,ALL\n")), 10, 1e-14);
  EXPECT_NEAR(total(read_deck(deck + "NSML,9,PROD,4,5.\nNSML1,9,ELEMENT,3.,2,5\n")), 8, 1e-14);
  EXPECT_NEAR(total(read_deck("PARAM,WTMASS,.5\n" + deck + "NSML1,9,PSHELL,3.,1,THRU,5,BY,2\n")),
              1.5, 1e-14);
  // Of a total each element has its share by size: 2 of area 1 and the bar, at their nodes.
  const auto mesh = read_deck(deck + "NSML1,9,ELEMENT,3.,2,5\n");
  ASSERT_EQ(mesh.masses.size(), 4u);
  EXPECT_NEAR(mesh.masses[0].mass, 1.5 / 4, 1e-15);
  EXPECT_NEAR(mesh.masses[3].mass, 1.5 / 4 + 1.5 / 2, 1e-15);
  const auto none = read_deck(deck + "NSM,9,PTUBE,2,5.\n");
  EXPECT_TRUE(none.masses.empty());
  EXPECT_TRUE(has_note(none, "NSM: it names no shell or line element"));
  // With case control only what it asks for.
  const std::string cards = "NSM,9,PROD,4,1.\nNSM,8,PROD,4,10.\nNSM,7,PROD,4,100.\nNSMADD,6,8,7\n";
  EXPECT_NEAR(total(read_deck("SOL 103\nCEND\nNSM = 9\nBEGIN BULK\n" + deck + cards)), 2, 1e-14);
  EXPECT_NEAR(total(read_deck("SOL 103\nCEND\nNSM = 6\nBEGIN BULK\n" + deck + cards)), 220, 1e-13);
  const auto unasked = read_deck("SOL 103\nCEND\nBEGIN BULK\n" + deck + cards);
  EXPECT_TRUE(unasked.masses.empty());
  EXPECT_TRUE(has_note(unasked, "does not ask for it (NSM = 9)"));
}

TEST(NastranCards, matrices_that_the_case_control_adds_are_named_as_missing) {
  const auto mesh =
      read_deck("SOL 103\nCEND\nK2GG = KAAX\nBEGIN BULK\n" + kTetra + "DMIG,KAAX,0,6,1,0\n");
  EXPECT_TRUE(has_note(mesh, "K2GG = KAAX: matrices of the deck (DMIG) are left out"));
  EXPECT_TRUE(std::any_of(mesh.notes.begin(), mesh.notes.end(),
                          [](const fem::ImportNote& note) { return note.is_doubtful; }));
}

TEST(NastranCards, material_direction_by_coordinate_system) {
  const std::string deck = kTetra +
                           "MAT8,2,1.+5,1.+4,.3,5.+3\nPCOMP,2\n,2,.1,0.\n"
                           "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,1.,0.\n"
                           "CORD2C,8,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                           "CTRIA3,2,2,1,2,3,7\nCTRIA3,3,2,1,2,4,8\n";
  const auto mesh = read_deck(deck);
  ASSERT_EQ(mesh.properties.size(), 3u);
  EXPECT_EQ(mesh.properties[1].name, "PCOMP 2");
  EXPECT_EQ(mesh.properties[2].name, "PCOMP 2");
  const Vector3d diagonal = Vector3d(1, 1, 0).normalized();
  EXPECT_LT((mesh.properties[1].axes->col(0) - diagonal).norm(), 1e-14);
  // The centre of this triangle lies above the x axis: radial there.
  EXPECT_LT((mesh.properties[2].axes->col(0) - Vector3d::UnitX()).norm(), 1e-14);
}

TEST(NastranCards, directions_along_the_sides_of_a_curved_shell_are_one_property) {
  // Two triangles whose first sides lie in other directions, and one with THETA.
  const std::string deck = kTetra + "MAT8,2,1.+5,1.+4,.3,5.+3,,,1500.\nPSHELL,2,2,.1,2\n" +
                           "CTRIA3,2,2,1,2,3\nCTRIA3,3,2,2,3,4\nCTRIA3,4,2,3,1,4,30.\n";
  const auto mesh = read_deck(deck);
  ASSERT_EQ(mesh.properties.size(), 3u);  // that of the tetrahedron, too
  EXPECT_EQ(mesh.blocks[1].ids, (std::vector<std::int64_t>{2, 3}));
  EXPECT_TRUE(mesh.properties[1].layers.empty());
  EXPECT_TRUE(mesh.properties[1].along_first_side);
  ASSERT_EQ(mesh.properties[2].layers.size(), 1u);
  EXPECT_EQ(mesh.properties[2].layers[0].thickness, 0.1);
  EXPECT_NEAR(mesh.properties[2].layers[0].angle, std::acos(-1.0) / 6, 1e-15);
  // In a report they are one, with the mass of all.
  const fem::MeshReport report = fem::report_mesh(mesh, true);
  ASSERT_EQ(report.properties.size(), 2u);
  EXPECT_EQ(report.properties[1].name, "PSHELL 2");
  EXPECT_EQ(report.properties[1].elements, 3);
  const double area = 0.5 + std::sqrt(3.0) / 2 + 0.5;
  EXPECT_NEAR(report.properties[1].mass, 1500 * 0.1 * area, 1e-12);
}

TEST(NastranCards, a_layer_is_there_if_any_of_its_fields_is) {
  const auto layers = [](const std::string& rows, const char* card = "PCOMP,2\n") {
    return read_deck(kTetra + "CTRIA3,2,2,1,2,3\n" + card + rows).properties.at(1).layers;
  };
  EXPECT_EQ(layers(",1,.1,,YES,,,,YES\n,,,90.\n").size(), 3u);
  EXPECT_EQ(layers(",1,.1,,YES,,,,YES\n,,,90.\n").at(1).thickness, 0.1);
  EXPECT_EQ(layers(",1,.1,,YES\n,,,,,1,.2\n").size(), 2u);
  EXPECT_EQ(layers(",5,1,.1,,YES\n,6,,,,NO\n", "PCOMPG,2\n").size(), 2u);
}

TEST(NastranCards, ends_of_bars_may_have_a_zero_for_no_components) {
  const auto link = [](const std::string& fields) {
    return read_deck(kTetra + "RBAR,9,1,2," + fields + "\n").rigid_links.at(0);
  };
  for (const char* fields : {"123456", "123456,0", "123456,0,0,0", "123456,,,123456"}) {
    EXPECT_EQ(link(fields).reference, 0) << fields;
    EXPECT_TRUE(link(fields).variables[5]) << fields;
  }
  EXPECT_EQ(link("0,123456").reference, 1);
  EXPECT_FALSE(link("123456,0,0,123").variables[5]);
}

TEST(NastranCards, two_of_three_moduli_are_enough) {
  const auto with = [](const std::string& fields) {
    return read_deck("GRID,1\nGRID,2,,1.\nCROD,1,1,1,2\nPROD,1,1,1.\nMAT1,1," + fields + "\n")
        .materials.at(0);
  };
  EXPECT_NEAR(with("2.6,1.").nu, 0.3, 1e-15);
  EXPECT_EQ(with(",1.,.3").E, 2.6);
  EXPECT_FALSE(with("2.6,,.3").G.has_value());
  // Bars have no use for G.
  EXPECT_FALSE(with("2.6,.9,.3").G.has_value());
}

TEST(NastranCards, boxes_with_two_wall_thicknesses_become_general_sections) {
  const auto mesh = read_deck(
      "GRID,1\nGRID,2,,1.\nCBAR,1,1,1,2,0.,1.,0.\n"
      "PBARL,1,1,,BOX\n,4.,6.,1.,.5\nMAT1,1,1.,,.3\n");
  const auto section = std::get<fem::GeneralSectionSpec>(mesh.properties.at(0).section->shape);
  EXPECT_NEAR(section.A, 4 * 6 - 3 * 4, 1e-13);
  EXPECT_NEAR(section.Iz, (4 * 216 - 3 * 64) / 12.0, 1e-12);  // across y, the height
  EXPECT_NEAR(section.Iy, (6 * 64 - 4 * 27) / 12.0, 1e-12);
  EXPECT_NEAR(section.J, 4 * std::pow(3.5 * 5, 2) / (2 * 3.5 / 1 + 2 * 5 / 0.5), 1e-12);
}

TEST(NastranCards, equations_in_turned_systems_are_turned_back) {
  const auto mesh = read_deck("CORD2R,1,,0.,0.,0.,0.,0.,1.\n,3.,4.,0.\n" + kTetra +
                              "GRID,9,,1.,1.,1.,1\nMPC,1,9,1,1.,1,3,2.\n");
  const auto& terms = mesh.equations.at(0).terms;
  ASSERT_EQ(terms.size(), 3u);
  // Direction (0.6, 0.8, 0): the largest part comes first.
  EXPECT_EQ(terms[0].variable, 1);
  EXPECT_NEAR(terms[0].coefficient, 0.8, 1e-15);
  EXPECT_NEAR(terms[1].coefficient, 0.6, 1e-15);
  EXPECT_EQ(terms[2].variable, 2);
}

TEST(NastranCards, springs_along_their_nodes_need_no_links) {
  const auto mesh = read_deck("GRID,1\nGRID,2,,0.,2.\nCBUSH,1,1,1,2\nPBUSH,1,K,5.\n");
  ASSERT_EQ(mesh.springs.size(), 1u);
  EXPECT_TRUE(mesh.rigid_links.empty());
  EXPECT_NEAR(mesh.springs[0].stiffness(1, 1), 5.0, 1e-15);
  EXPECT_EQ(mesh.springs[0].stiffness(0, 0), 0.0);
  const auto grounded = read_deck("GRID,1\nCBUSH,1,1,1\nPBUSH,1,K,5.\n");
  EXPECT_TRUE(grounded.springs.empty());
  EXPECT_TRUE(has_note(grounded, "to ground"));
}

TEST(NastranCards, means_by_components) {
  const auto mesh = read_deck(kTetra +
                              "RBE3,8,,1,1356,1.,123,2,3\n,4\n"
                              "RBE3,9,,1,123,2.,1,2,3.\n,12,3,4,UM,2,123\n");
  ASSERT_EQ(mesh.averages.size(), 2u);
  using Six = std::array<bool, 6>;
  EXPECT_EQ(mesh.averages[0].variables, (Six{true, false, true, false, true, true}));
  EXPECT_TRUE(mesh.averages[0].components.empty());
  EXPECT_EQ(mesh.averages[1].variables, (Six{true, true, true, false, false, false}));
  EXPECT_EQ(mesh.averages[1].nodes, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(mesh.averages[1].weights, (std::vector<double>{2, 3, 3}));
  using Three = std::array<bool, 3>;
  EXPECT_EQ(mesh.averages[1].components,
            (std::vector<Three>{{true, false, false}, {true, true, false}, {true, true, false}}));
}

TEST(NastranCards, tapered_shapes_need_no_word_for_their_stresses) {
  for (const char* station : {"YES,1.", "NO,", ",1.", ","}) {
    const auto mesh = read_deck(
        "GRID,1\nGRID,2,,1.\nCBEAM,1,1,1,2,0.,1.,0.\nMAT1,1,1.,,.3\n"
        "PBEAML,1,1,,BAR\n,4.,8.,," +
        std::string(station) + ",2.,6.\n");
    const auto bar = std::get<fem::RectangleSpec>(mesh.properties.at(0).section->shape);
    EXPECT_EQ(bar.height, 3.0) << station;
    EXPECT_EQ(bar.width, 7.0) << station;
  }
}

TEST(NastranCards, blank_shear_moduli_across_shells_are_noted) {
  const std::string shell = "PSHELL,2,2,.1,2\nCTRIA3,2,2,1,2,3\n";
  const auto mesh = read_deck(kTetra + "MAT8,2,9.,1.,.3,.5\n" + shell);
  EXPECT_EQ(mesh.materials.at(1).orthotropic->G13, 0.5);
  EXPECT_TRUE(has_note(mesh, "G12 is taken"));
}

TEST(NastranCards, a_mass_may_be_placed_in_the_basic_system) {
  const auto mesh = read_deck("GRID,1,,1.,1.,1.\nCONM2,1,1,-1,2.,1.,2.,3.\n");
  EXPECT_EQ(mesh.masses.at(0).offset, Vector3d(0, 1, 2));
}

TEST(NastranCards, names_of_femap_and_doubles) {
  const auto mesh =
      read_deck("$ Femap with NX Nastran Property 1 : hull\n$ Femap Material 1 : iron\n" + kTetra);
  EXPECT_EQ(mesh.properties.at(0).name, "hull");
  EXPECT_EQ(mesh.materials.at(0).name, "iron");
}

}  // namespace
}  // namespace buckens::mesh_io
