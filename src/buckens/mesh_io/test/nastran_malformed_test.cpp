// SPDX-License-Identifier: Apache-2.0
// Decks that cannot be converted: a message with file, line and remedy.
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "buckens/base/test/source_directory.h"
#include "buckens/mesh_io/test/nastran_sample.h"

namespace buckens::mesh_io {
namespace {

using test::expect_words;
using test::kTetra;
using test::refusal;

TEST(NastranMalformed, fields_that_are_no_numbers) {
  expect_words(refusal("GRID,1,,0.,0.\nGRID,2,,nan,0.\n"),
               {"deck.bdf:2:9: ", "GRID 2, field 4", "\"nan\" is not a number"});
  expect_words(refusal("GRID,1.5\n"), {"deck.bdf:1:6: ", "\"1.5\" is not an integer"});
  expect_words(refusal("GRID,0\n"), {"0 is not a number from 1 to 999999999999999"});
  expect_words(refusal("GRID,99999999999999999999\n"), {"is not an integer"});
  expect_words(refusal("GRID,1000000000000000\n"), {"1000000000000000 is not a number from 1"});
  expect_words(refusal("GRID    1               1.0.0\n"), {"deck.bdf:1:25: ", "field 4"});
  expect_words(refusal("GRID\n"), {"deck.bdf:1:1: ", "field 2: is blank"});
  expect_words(refusal(kTetra + "MAT1,2,2.+400,,.3\nPSOLID,2,2\nCTETRA,2,2,1,2,3,4\n"),
               {"deck.bdf:8:8", "is not a number"});
}

TEST(NastranMalformed, lines_that_are_no_cards) {
  expect_words(refusal(",1,2\n"), {"deck.bdf:1:1", "none before it"});
  expect_words(refusal("GRID,1\n#!?,2\n"), {"deck.bdf:2:1", "\"#!?\" is not the name"});
  expect_words(refusal("GRID,1,,1,2,3,4,5,6,7,8\n"), {"deck.bdf:1:", "eight fields at most"});
  expect_words(
      refusal("GRID    1                                                               +A\n"
              "+B      2\n"),
      {"deck.bdf:2:1", "found continuation \"+B\" where \"+A\""});
  expect_words(refusal("\x7f"
                       "ELF\x02\x01\x01\xff\xfe\n"),
               {"deck.bdf:1:1", "is not the name"});
  expect_words(refusal(std::string("GRID,1\n\0\0\0\n", 11)), {"deck.bdf:2:1", "zero byte"});
}

TEST(NastranMalformed, missing_parts) {
  expect_words(refusal(""), {"deck.bdf: ", "no nodes"});
  expect_words(refusal("SOL 101\nCEND\n" + kTetra), {"no BEGIN BULK"});
  expect_words(refusal(kTetra + "CTETRA,2,1,1,2,3,77\n"),
               {"deck.bdf:8:1: ", "CTETRA 2: there is no GRID 77"});
  expect_words(refusal(kTetra + "CTETRA,2,1,1,2,3\n"), {"deck.bdf:8:1", "field 7: is blank"});
  expect_words(refusal(kTetra + "GRID,9,5\n"), {"deck.bdf:8:1", "no coordinate system 5"});
  expect_words(refusal(kTetra + "SET3,1,GRID,9\n"), {"SET3 1: there is no GRID 9"});
  expect_words(refusal(kTetra + "RBE2,9,1,123,44\n"), {"RBE2 9, field 5: there is no GRID 44"});
}

TEST(NastranMalformed, numbers_used_twice) {
  expect_words(refusal(kTetra + "GRID,1,,5.\n"), {"deck.bdf:8:1: ", "GRID 1", "deck.bdf:1"});
  expect_words(refusal(kTetra + "CTETRA,1,1,1,2,3,4\n"), {"deck.bdf:8:1: ", "deck.bdf:5"});
  expect_words(refusal(kTetra + "PSOLID,1,1\n"), {"deck.bdf:8:1: ", "another property"});
  expect_words(refusal(kTetra + "MAT8,1,1.,1.,.3,1.\n"), {"deck.bdf:8:1: ", "another material"});
  expect_words(refusal(kTetra + "CTETRA,2,1,1,2,3,3\n"), {"node 3 appears there twice"});
}

TEST(NastranMalformed, circles_of_coordinate_systems) {
  expect_words(refusal("GRID,1\nCORD2R,1,2,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                       "CORD2R,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"),
               {"deck.bdf:", "depends on itself"});
  expect_words(refusal("GRID,1,1\nGRID,2,,1.\nGRID,3,,,1.\nCORD1R,1,1,2,3\n"),
               {"deck.bdf:4:1", "depends on itself"});
  expect_words(refusal("GRID,1\nCORD2R,1,,0.,0.,0.,0.,0.,1.\n,0.,0.,5.\n"),
               {"deck.bdf:2:1", "on one line"});
  // A long chain must not exhaust the stack.
  std::string chain = "GRID,1,50000\n";
  for (int i = 1; i <= 50000; ++i) {
    chain += "CORD2R," + std::to_string(i) + ',' + std::to_string(i < 50000 ? i + 1 : 0) +
             ",0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n";
  }
  EXPECT_EQ(refusal(chain), "");
}

TEST(NastranMalformed, what_is_refused_says_why) {
  expect_words(refusal(kTetra + "CSHEAR,9\n"), {"deck.bdf:8:1", "shear panels", "skip: [CSHEAR]"});
  expect_words(refusal(kTetra + "CNEW,9\n"), {"deck.bdf:8:1", "CNEW 9", "skip: [CNEW]"});
  expect_words(refusal(kTetra + "CQUAD8,9,1,1,2,3,4,5\n"), {"deck.bdf", "there is no GRID 5"});
  expect_words(refusal(kTetra + "GRID,5,,1.,1.\nCTETRA,2,1,1,2,3,,5\n"), {"deck.bdf:9", "blank"});
  expect_words(refusal(kTetra + "NSM,5,PFOO,1,2.\n"), {"deck.bdf:8:", "PSHELL", "found \"PFOO\""});
  expect_words(refusal("SOL 101\nCEND\nNSM = 1\nNSM = 2\nBEGIN BULK\n" + kTetra),
               {"deck.bdf:4:1", "NSM = 2", "non-structural masses"});
  expect_words(refusal(kTetra + "PSHELL,2,1,,1\nCTRIA3,2,2,1,2,3\n,,,.1,,.3\n"),
               {"deck.bdf:9:1", "CTRIA3 2", "is blank and its PSHELL gives no thickness"});
  expect_words(refusal(kTetra + "PSHELL,2,1,.1,-1\nCTRIA3,2,2,1,2,3\n"),
               {"deck.bdf:8:", "MID2 = -1", "plane strain", "write MID2 = 1 for a shell"});
  expect_words(refusal(kTetra + "PSHELL,2,1,.1,1,,1,,\n,,,7\nCTRIA3,2,2,1,2,3\n"),
               {"deck.bdf:", "MID4 = 7", "PCOMP", "leave MID4 blank"});
  expect_words(refusal(kTetra + "PBAR,2,1,1.,1.,1.,1.\nCBAR,2,2,1,2,1.,0.,0.\n"),
               {"orientation vector is parallel to the beam"});
  expect_words(refusal(kTetra + "PCOMP,2,,,,,,,MEM\n,1,1.\nCTRIA3,2,2,1,2,3\n"), {"LAM = MEM"});
  expect_words(refusal(kTetra + "RBAR,2,1,2,123,4\n"),
               {"4 components are independent", "six in all"});
  expect_words(refusal(kTetra + "CBAR,2,2,1,2\nPBAR,2,1,1.,1.,1.,1.\n"),
               {"CBAR 2: the orientation vector is missing"});
  expect_words(refusal(kTetra + "CELAS2,9,1.,1,1,2,2\n"),
               {"component 1 of GRID 1", "component 2 of GRID 2", "skip: [CELAS2]"});
  expect_words(refusal(kTetra + "CMASS2,9,1.,1,1\n"), {"GRID 1", "1, 0 and 0", "use CONM2"});
  expect_words(refusal(kTetra + "SPOINT,9\nCMASS2,9,1.,9,0\n"),
               {"scalar point 9", "no position in space"});
  expect_words(refusal(kTetra + "CONM1,9,1,,2.,,1.\n"), {"CONM1 9", "not that of a rigid body"});
  expect_words(refusal(kTetra + "=(2000000),*1\n"), {"deck.bdf:8:1", "more than 1000000"});
  expect_words(refusal("=,1\n"), {"deck.bdf:1:1", "there is none"});
  expect_words(refusal("SOL 101\nCEND\nBEGIN BULK\n" + kTetra + "BEGIN SUPER=1\n"),
               {"deck.bdf:11:1", "superelement", "skip: [SUPER]"});
  expect_words(refusal(kTetra + "RBE3,2,,1,,1.,123,2,3,4\n"), {"give the components REFC"});
  expect_words(refusal(kTetra + "RBE3,2,,1,123,1.,456,2,3\n,4\n"),
               {"deck.bdf:8:18", "averages of rotations alone"});
  expect_words(refusal(kTetra + "RBE3,2,,1,123,1.,123,2,THRU\n,4\n"),
               {"expected a node, found THRU"});
  expect_words(refusal("CORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,1.,0.\n" + kTetra +
                       "GRID,9,,1.,1.,1.,7\nRBE3,2,,1,123,1.,1,2,3\n,9\n"),
               {"single components at GRID 9"});
  expect_words(refusal(kTetra + "PBEAML,2,1,,BAR\n,1.,2.,,3.,1.\nCBEAM,2,2,1,2,0.,0.,1.\n"),
               {"expected SO, YES or NO, found \"3.\"", "2 dimensions"});
  expect_words(refusal(kTetra + "MAT9,3,3.,1.,1.,.5,,,3.\n,1.,,,,3.\n,1.,,,1.,,1.\n"
                                "PSOLID,2,3\nCTETRA,2,2,1,2,3,4\n"),
               {"couples tension and shear in all axes"});
  expect_words(refusal(kTetra + "MAT1,3,1.,,.7\nPSOLID,2,3\nCTETRA,2,2,1,2,3,4\n"),
               {"Poisson's ratio 0.7"});
  expect_words(refusal(kTetra + "CONM2,3,1,,-1.\n"), {"the mass -1 is negative"});
}

/// Files by name instead of a directory.
fem::ImportedMesh read_files(const std::map<std::string, std::string>& files) {
  return read_nastran_text(files.at("a.bdf"), "a.bdf", [&](const std::filesystem::path& path) {
    const auto entry = files.find(path.filename().string());
    if (entry == files.end()) throw IoError(path.string() + ": there is no such file");
    return entry->second;
  });
}

std::string refusal_of_files(const std::map<std::string, std::string>& files) {
  try {
    read_files(files);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(NastranInclude, files_are_put_in_place) {
  const auto mesh = read_files({{"a.bdf", "SOL 101\nCEND\ninclude 'b.bdf'\nBEGIN BULK\n" + kTetra +
                                              "INCLUDE 'long\n  name.bdf'\nENDDATA\n"},
                                {"b.bdf", "TITLE = b\n"},
                                {"longname.bdf", "GRID,11,,1.,2.,3.\nFORCE,1,1\n"}});
  EXPECT_EQ(mesh.num_nodes(), 5);
  EXPECT_TRUE(test::has_note(mesh, "longname.bdf: FORCE"));
}

TEST(NastranInclude, files_stand_beside_the_deck) {
  const auto mesh = read_nastran_deck(std::filesystem::path(buckens::test::kSourceDirectory) /
                                      "tests/decks/nastran/include.bdf");
  EXPECT_EQ(mesh.num_nodes(), 4);
  EXPECT_EQ(mesh.num_elements(), 1);
}

TEST(NastranInclude, circles_doubles_and_missing_files_are_refused) {
  expect_words(
      refusal_of_files({{"a.bdf", "GRID,1\nINCLUDE 'b.bdf'\n"}, {"b.bdf", "INCLUDE a.bdf"}}),
      {"b.bdf:1:1: ", "must not include each other"});
  expect_words(refusal_of_files({{"a.bdf", "INCLUDE 'a.bdf'\n"}}),
               {"a.bdf:1:1: ", "must not include each other"});
  expect_words(
      refusal_of_files({{"a.bdf", "GRID,1\nINCLUDE 'b'\nINCLUDE 'b'\n"}, {"b", "GRID,2\n"}}),
      {"a.bdf:3:1: ", "already been included"});
  expect_words(refusal_of_files({{"a.bdf", "GRID,1\nINCLUDE 'none.bdf'\n"}}),
               {"a.bdf:2:1: ", "none.bdf", "no such file"});
  expect_words(refusal_of_files({{"a.bdf", "INCLUDE 'b\n"}}), {"a.bdf:1:1: ", "quotation mark"});
  expect_words(refusal_of_files({{"a.bdf", "INCLUDE\n"}}), {"has no file name"});
  expect_words(refusal_of_files({{"a.bdf", "GRID,1\nINCLUDE b\n"}, {"b", ",2\n"}}),
               {"b:1:1: ", "another file"});
}

TEST(NastranInclude, only_regular_files) {
  EXPECT_THROW(load_nastran_file("/dev/zero"), IoError);
  EXPECT_THROW(load_nastran_file("/"), IoError);
}

TEST(NastranMalformed, garbage) {
  unsigned state = 1;
  for (const std::string& start : {std::string(), "BEGIN BULK\n" + kTetra, kTetra + "GRID,9,"}) {
    std::string text = start;
    for (int k = 0; k < 20000; ++k) {
      state = state * 1664525u + 1013904223u;
      text.push_back(static_cast<char>(1 + (state >> 24) % 255));
    }
    expect_words(refusal(text), {"deck.bdf:"});
    EXPECT_NE(refusal(text), "");
  }
}

TEST(NastranMalformed, every_beginning_of_a_deck_is_read_or_refused) {
  const auto path = std::filesystem::path(buckens::test::kSourceDirectory) /
                    "tests/decks/nastran/every_card_small.bdf";
  std::ifstream stream(path);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_GT(text.size(), 1000u);
  int num_refused = 0;
  for (std::size_t size = 0; size < text.size(); size += 7) {
    num_refused += refusal(text.substr(0, size)).empty() ? 0 : 1;
  }
  // If the deck or its reader is changed, count again and examine the difference.
  EXPECT_EQ(num_refused, 571);
}

}  // namespace
}  // namespace buckens::mesh_io
