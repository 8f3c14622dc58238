// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/mesh_io/abaqus/deck.h"

namespace buckens::mesh_io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Decks in a separate folder.
class AbaqusMalformed : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// Expects an error of the input with all these words.
  void refuses(const std::string& text, const std::vector<std::string>& words) const {
    const fs::path path = write("deck.inp", text);
    try {
      read_abaqus_deck(path);
    } catch (const InputError& error) {
      for (const std::string& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
      return;
    }
    ADD_FAILURE() << "nothing was refused, expected: " << words.front();
  }

  buckens::test::TemporaryDirectory folder_;
};

const char* const kNodeCards =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";

std::string with_nodes(const std::string& rest) { return kNodeCards + rest; }

TEST_F(AbaqusMalformed, FilesThatAreNoDecks) {
  EXPECT_THROW(read_abaqus_deck(folder_ / "missing.inp"), IoError);
  EXPECT_THROW(read_abaqus_deck(folder_.path()), IoError);
  refuses("", {"deck.inp", "no *NODE"});
  refuses("*HEADING\nnothing else\n", {"no *NODE"});
  refuses("1, 2, 3\n*NODE\n", {"deck.inp:1:1", "before any keyword"});
  refuses("*\n", {"deck.inp", "no *NODE"});
  refuses("*NODE\n1,0,0,0\n" + std::string(3, '\0') + "ELF", {"deck.inp:3:1", "not text"});
  std::string garbage;
  unsigned state = 1;
  for (int k = 0; k < 100000; ++k) {
    state = state * 1664525u + 1013904223u;
    garbage.push_back(static_cast<char>(1 + (state >> 24) % 255));
  }
  EXPECT_THROW(read_abaqus_deck(write("garbage.inp", garbage)), InputError);
}

TEST_F(AbaqusMalformed, NodesThatAreNone) {
  refuses("*NODE\n1, 0, NaN, 0\n", {"deck.inp:2:1", "NaN", "finite"});
  refuses("*NODE\n1, 0, 1e400, 0\n", {"1e400", "finite"});
  refuses("*NODE\n1, 0, 12;5, 0\n", {"12;5"});
  refuses("*NODE\n99999999999, 0, 0, 0\n", {"99999999999", "1 to 999999999"});
  refuses("*NODE\n-4, 0, 0, 0\n", {"-4"});
  refuses("*NODE\nabc, 0, 0, 0\n", {"abc"});
  refuses("*NODE\n1,0,0,0\n1,0,0,1\n", {"deck.inp:3:1", "node 1", "second time"});
  refuses("*NODE, SYSTEM=Q\n1,0,0,0\n", {"SYSTEM=Q"});
  refuses("*NGEN\n1,5\n", {"deck.inp:2:1", "node 1 is not defined"});
  refuses(with_nodes("*NGEN\n1,8,2\n"), {"deck.inp:11:1", "do not lead from node 1 to node 8"});
  refuses(with_nodes("*NODE\n900000000,1,1,1\n*NGEN\n1,900000000\n"), {"would be generated"});
  refuses(with_nodes("*NGEN, LINE=P\n1,8\n"), {"parabolas", "mesh: {skip: [NGEN]}"});
  refuses(with_nodes("*NCOPY, OLD SET=A, CHANGE NUMBER=1E9, SHIFT\n"), {"CHANGENUMBER=1E9"});
  refuses(with_nodes("*NCOPY, OLD SET=A, CHANGE NUMBER=9, SHIFT\n"), {"no set \"A\""});
  refuses(with_nodes("*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7,8\n*ELGEN\n1,90000000\n"),
          {"deck.inp:13:1", "90000000"});
  // The same node twice at one place is harmless.
  EXPECT_EQ(read_abaqus_deck(write("deck.inp", "*NODE\n1,0,0,0\n1,0,0,0\n")).num_nodes(), 1);
}

TEST_F(AbaqusMalformed, HugeNumbersCostNoMemory) {
  const auto mesh = read_abaqus_deck(write("deck.inp", "*NODE\n999999999,0,0,0\n1,1,0,0\n"));
  EXPECT_EQ(mesh.num_nodes(), 2);
  refuses(with_nodes("*NSET, NSET=A, GENERATE\n1, 999999999, 1\n"),
          {"deck.inp:11:1", "999999999 numbers"});
  refuses(with_nodes("*NSET, NSET=A, GENERATE\n100, 200, 1\n"), {"no such node"});
  refuses(with_nodes("*NSET, NSET=A, GENERATE\n8, 1\n"), {"precedes the first"});
  refuses(with_nodes("*NSET, NSET=A, GENERATE\n1, 8, 0\n"), {"the step"});
}

TEST_F(AbaqusMalformed, OverlappingRangesCostNoMoreThanTheirNodes) {
  std::string text = with_nodes("") + "*NSET, NSET=A, GENERATE\n";
  for (int k = 0; k < 20000; ++k) text += "1, 99999999, 1\n1, 8, 1\n";
  const auto mesh = read_abaqus_deck(write("deck.inp", text));
  EXPECT_EQ(mesh.node_sets.at(0).nodes.size(), 8u);
}

TEST_F(AbaqusMalformed, ManyInstancesAreLookedUpAtOnce) {
  // 3000 instances, and as many references to them: there must be no search over all for each.
  std::string text = "*PART, NAME=P\n*NODE\n1,0,0,0\n*END PART\n*ASSEMBLY, NAME=A\n";
  std::string set = "*NSET, NSET=ALL\n";
  for (int k = 0; k < 3000; ++k) {
    text += fmt::format("*INSTANCE, NAME=I{0}, PART=P\n{0}, 0, 0\n*END INSTANCE\n", k);
    set += fmt::format("I{}.1\n", k);
  }
  const auto mesh = read_abaqus_deck(write("deck.inp", text + set + "*END ASSEMBLY\n"));
  EXPECT_EQ(mesh.node_sets.at(0).nodes.size(), 3000u);
  refuses(text + "*INSTANCE, NAME=i7, PART=P\n", {"instance \"i7\"", "second time"});
}

TEST_F(AbaqusMalformed, DataThatAKeywordLineSwallows) {
  // A number begins the data, also behind a comma; a name belongs to the keyword.
  EXPECT_EQ(read_abaqus_deck(write("deck.inp", "*NODE,\n1, 0, 0, 0\n")).num_nodes(), 1);
  refuses("*NODE, NSET=A, 1\n", {"deck.inp:1:1", "\"1\" is not a parameter of *NODE", "comma"});
}

TEST_F(AbaqusMalformed, ASetMayHaveANumberForItsName) {
  const auto mesh = read_abaqus_deck(write("deck.inp", with_nodes("*NSET, NSET=3\n5, 6\n")));
  ASSERT_EQ(mesh.node_sets.size(), 1u);
  EXPECT_EQ(mesh.node_sets[0].nodes, (std::vector<int>{4, 5}));
}

TEST_F(AbaqusMalformed, ElementsThatAreNone) {
  refuses(with_nodes("*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,7\n"),
          {"deck.inp:11:1", "C3D8 has 8 nodes", "found 7"});
  refuses(with_nodes("*ELEMENT, TYPE=B31\n1, 1,2,3,4\n"), {"B31 has 2 nodes", "found 4"});
  refuses(with_nodes("*ELEMENT, TYPE=B32\n1, 1,2\n"),
          {"deck.inp:11:1", "B32 has 3 nodes", "found 2", "is a B31"});
  refuses(with_nodes("*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,\n5,6,\n"), {"the data end here", "6 of"});
  refuses(with_nodes("*ELEMENT, TYPE=C3D4\n7, 1,2,3,99\n"),
          {"deck.inp:11:1", "element 7", "node 99", "not defined"});
  refuses(with_nodes("*ELEMENT, TYPE=C3D4\n7, 1,2,3,5\n7, 1,2,3,5\n"),
          {"deck.inp:12:1", "element 7", "second time"});
  refuses(with_nodes("*ELEMENT, TYPE=CAX4\n1, 1,2,3,4\n"),
          {"CAX4", "axisymmetric", "mesh: {skip: [CAX4]}"});
  refuses(with_nodes("*ELEMENT, TYPE=X9\n1, 1,2,3,4\n"), {"X9", "cannot be used"});
  refuses(with_nodes("*ELEMENT\n1, 1,2,3,4\n"), {"*ELEMENT needs the parameter TYPE="});
  refuses(with_nodes("*ELEMENT, TYPE=C3D4\n1, 1,2,3,x\n"), {"\"x\""});
  refuses(with_nodes("*ELEMENT, TYPE=MASS, ELSET=M\n1, 1\n"), {"no *MASS"});
}

TEST_F(AbaqusMalformed, SetsAndSurfacesThatReferToNothing) {
  const std::string tet = with_nodes("*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1,2,3,5\n");
  refuses(with_nodes("*NSET, NSET=A\n1, 77\n"), {"deck.inp:10:1", "\"A\"", "node 77"});
  refuses(with_nodes("*NSET, NSET=A\nBX\n*NSET, NSET=BY\n1\n"), {"no node set \"BX\"", "BY"});
  refuses(with_nodes("*NSET, NSET=A\nB\n*NSET, NSET=B\nA\n"), {"contains itself"});
  refuses(tet + "*ELSET, ELSET=F\n2\n", {"deck.inp:12:1", "element 2"});
  refuses(tet + "*SURFACE, NAME=S\nE, S5\n", {"deck.inp:13:1", "no face \"S5\"", "S1 to S4"});
  refuses(tet + "*SURFACE, NAME=S\nG, S1\n", {"no element set \"G\""});
  refuses(tet + "*COUPLING, CONSTRAINT NAME=C, REF NODE=8, SURFACE=T\n*KINEMATIC\n",
          {"no surface \"T\""});
}

TEST_F(AbaqusMalformed, SetsOfSetsWithoutEndDoNotTakeForEver) {
  // Each set contains the next one twice under two names: 2^60 paths through them.
  std::string text = kNodeCards;
  for (int k = 0; k < 60; ++k) {
    text += fmt::format("*NSET, NSET=A{0}\nA{1}, B{1}\n*NSET, NSET=B{0}\nA{1}, B{1}\n", k, k + 1);
  }
  text += "*NSET, NSET=A60\n1\n*NSET, NSET=B60\n2\n";
  EXPECT_EQ(read_abaqus_deck(write("deck.inp", text)).node_sets.size(), 122u);
}

TEST_F(AbaqusMalformed, IncludedFilesAreNamedWithTheirOwnLines) {
  write("nodes.inc", "1,0,0,0\n2,1,0,0\n3,x,0,0\n");
  refuses("*NODE\n*INCLUDE, INPUT=nodes.inc\n", {"nodes.inc:3:1", "\"x\""});
  refuses("*NODE, INPUT=nodes.inc\n", {"nodes.inc:3:1"});
  refuses("*INCLUDE, INPUT=nowhere.inc\n", {"deck.inp:1:1", "nowhere.inc", "no such file"});
  refuses("*INCLUDE\n", {"*INCLUDE needs the name of a file"});
  refuses("*INCLUDE, INPUT=/dev/tty\n",
          {"deck.inp:1:1", "/dev/tty", "not a file that can be included"});
}

TEST_F(AbaqusMalformed, CirclesAndCascadesOfIncludedFilesEnd) {
  refuses("*HEADING\n*INCLUDE, INPUT=deck.inp\n", {"deck.inp:2:1", "includes itself"});
  write("a.inc", "*INCLUDE, INPUT=b.inc\n");
  write("b.inc", "**\n*INCLUDE, INPUT=a.inc\n");
  refuses("*INCLUDE, INPUT=a.inc\n", {"b.inc:2:1", "includes itself"});
  // Every file includes the next one twice: 2^30 files if they were all read.
  for (int k = 0; k < 30; ++k) {
    write(fmt::format("c{}.inc", k), fmt::format("*INCLUDE, INPUT=c{0}.inc\n"
                                                 "*INCLUDE, INPUT=c{0}.inc\n",
                                                 k + 1));
  }
  write("c30.inc", "**\n");
  refuses("*INCLUDE, INPUT=c0.inc\n", {"in all"});
}

TEST_F(AbaqusMalformed, EveryBeginningOfADeckIsReadOrRefused) {
  const fs::path folder = fs::path(buckens::test::kSourceDirectory) / "tests/decks/abaqus";
  fs::copy(folder / "solids_nodes.inc", folder_ / "solids_nodes.inc");
  // If a deck or its reader is changed, count again and examine the difference.
  const std::map<std::string, int> refused = {
      {"assembly.inp", 215}, {"constraints.inp", 81}, {"lines.inp", 290}, {"solids.inp", 260}};
  for (const auto& [name, expected] : refused) {
    int num_refused = 0;
    std::ifstream stream(folder / name);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    ASSERT_GT(text.size(), 500u) << name;
    for (std::size_t size = 0; size < text.size(); size += 5) {
      const fs::path path = write("deck.inp", text.substr(0, size));
      try {
        read_abaqus_deck(path);
      } catch (const InputError& error) {
        const auto lines = std::count(text.begin(), text.begin() + static_cast<long>(size), '\n');
        EXPECT_THAT(error.what(), HasSubstr("deck.inp"));
        EXPECT_LE(error.where().line, lines + 1) << error.what();
        ++num_refused;
      }
    }
    EXPECT_EQ(num_refused, expected) << name;
  }
}

TEST_F(AbaqusMalformed, WhatIsCutOffOrNestedWrongly) {
  refuses("*PART, NAME=P\n*NODE\n1,0,0,0\n", {"deck.inp:1:1", "*PART", "truncated"});
  refuses(with_nodes("*STEP\n*STATIC\n"), {"deck.inp:10:1", "no *END STEP"});
  refuses("*PART, NAME=P\n*PART, NAME=Q\n", {"deck.inp:2:1", "*PART", "add *END PART"});
  refuses("*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=P\n*STEP\n",
          {"deck.inp:4:1", "appears within *INSTANCE", "*END INSTANCE is missing"});
  refuses("*END PART\n", {"has no beginning"});
  EXPECT_EQ(
      read_abaqus_deck(write("deck.inp", "*PART, NAME=P\n*NODE\n1,0,0,0\n*END PART\n")).num_nodes(),
      1);
  refuses("*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n", {"no part \"P\""});
  refuses("*PART, NAME=P\n*END PART\n*PART, NAME=p\n*END PART\n", {"second time"});
  refuses(
      "*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=P\n1,0,0\n0,0,0,0,0,0,90\n"
      "*END INSTANCE\n",
      {"deck.inp:5:1", "the same"});
}

TEST_F(AbaqusMalformed, MeasuresOfNodesAndElementsThatCannotBe) {
  const std::string shell = with_nodes("*ELEMENT, TYPE=S4, ELSET=E\n1, 1,2,3,4\n");
  const std::string beam = with_nodes("*ELEMENT, TYPE=B31, ELSET=E\n1, 1,2\n");
  const std::string nodal = beam + "*BEAM SECTION, ELSET=E, NODAL THICKNESS, SECTION=";
  refuses(nodal + "RECT\n", {"deck.inp:12:1", "node 1 has no *NODAL THICKNESS"});
  refuses(nodal + "PIPE\n", {"deck.inp:12:1", "it is for RECT and CIRC"});
  refuses(nodal + "RECT, OFFSET1=0.5\n", {"OFFSET1 with NODAL THICKNESS", "*MPC, BEAM"});
  refuses(nodal + "RECT\n*NODAL THICKNESS\n1, 1, 2\n2, 1, -2\n",
          {"deck.inp:15:1", "second thickness"});
  refuses(shell + "*SHELL SECTION, ELSET=E, SHELL THICKNESS=D\n1\n", {"no *DISTRIBUTION \"D\""});
  const std::string own = shell + "*SHELL SECTION, ELSET=E, SHELL THICKNESS=D\n";
  refuses(own + "1\n*DISTRIBUTION, NAME=D\n, -1\n", {"deck.inp:12:1", "must be positive"});
  refuses(own + "1\n*DISTRIBUTION, NAME=D\n7, 1\n", {"element 7"});
  refuses(shell + "*SHELL SECTION, ELSET=E, SHELL THICKNESS=D, COMPOSITE\n1, 3, P, 0.\n",
          {"layers with SHELL THICKNESS"});
}

TEST_F(AbaqusMalformed, SectionsAndMaterialsThatCannotBe) {
  const std::string shell = with_nodes("*ELEMENT, TYPE=S4, ELSET=E\n1, 1,2,3,4\n");
  const std::string beam = with_nodes("*ELEMENT, TYPE=B31, ELSET=E\n1, 1,2\n");
  const std::string steel = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2E11,0.3\n";
  refuses(shell + "*SHELL SECTION, ELSET=E\n-1\n", {"deck.inp:13:1", "thickness", "positive"});
  refuses(shell + "*SHELL SECTION, ELSET=E\n", {"thickness of the shell is missing"});
  refuses(shell + "*SOLID SECTION, ELSET=E\n", {"type S4", "no *SOLID SECTION"});
  refuses(shell + "*SHELL SECTION, ELSET=X\n1\n", {"no element set \"X\""});
  const auto notes = read_abaqus_deck(write("deck.inp", shell + steel +
                                                            "*SHELL SECTION, ELSET=E, "
                                                            "MATERIAL=STEAL\n1\n"))
                         .notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const fem::ImportNote& note) {
    return note.text.find("\"STEAL\" is not defined") != std::string::npos &&
           note.text.find("STEEL") != std::string::npos;
  }));
  refuses(shell + "*SHELL SECTION, ELSET=E, ORIENTATION=O\n1\n", {"no orientation \"O\""});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=L\n1,2,3\n", {"SECTION=L is not supported"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=I\n1,2,1,2,.1,.1,.1\n0,0,1\n",
          {"deck.inp:13:1", "equal flanges"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=I\n.5,1,1,1,.6,.6,.1\n0,0,1\n",
          {"no room for a web"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=CIRC\n1\n1,0,0\n",
          {"deck.inp:11:1", "lies along the beam"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=PIPE\n1, 2\n", {"thicker than the radius"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=CIRC\n1, -2\n",
          {"deck.inp:13:1", "second diameter of the circle is -2"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=GENERAL, OFFSET2=0.5\n1, 1, 0, 1, 1\n",
          {"deck.inp:12:1", "OFFSET2=0.5", "need a section of type RECT", "*MPC, BEAM"});
  refuses(beam + "*BEAM SECTION, ELSET=E, SECTION=RECT, OFFSET1=SPOS\n1, 2\n",
          {"deck.inp:12:1", "OFFSET1=SPOS", "expected a number"});
  refuses(beam + "*BEAM GENERAL SECTION, ELSET=E\n1,1,0.5,1,1\n", {"I12 must be zero"});
  refuses(with_nodes("*ELASTIC\n1,0\n"), {"belongs below a *MATERIAL"});
  refuses(with_nodes("*MATERIAL, NAME=A\n*ELASTIC\n1\n"), {"expected 2 constants, found 1"});
  refuses(with_nodes("*MATERIAL, NAME=A\n*ELASTIC\n-1, 0.3\n"), {"E = -1"});
  refuses(with_nodes("*MATERIAL, NAME=A\n*DENSITY\n-1\n"), {"negative"});
  refuses(with_nodes("*MATERIAL, NAME=A\n*ELASTIC, TYPE=ANISOTROPIC\n1\n"),
          {"expected 21 constants, found 1"});
  refuses(
      with_nodes("*MATERIAL, NAME=A\n*ELASTIC, TYPE=ANISOTROPIC\n"
                 "4,1,4,1,1,4,0.5,0\n0,1,0,0,0,0,1,0\n0,0,0,0,1\n"),
      {"deck.inp:", "material \"A\" couples stretch and shear in all axes", "materials: {\"A\""});
  refuses(with_nodes("*MATERIAL, NAME=A\n*ELASTIC, TYPE=ORTHO\n1,2,1,0,0,1,1,1\n1\n"),
          {"deck.inp:", "the stiffnesses of *ELASTIC are not positive definite"});
  refuses(with_nodes(steel + steel), {"defined twice"});
  refuses(with_nodes("*ORIENTATION, NAME=O\n1,0,0,2,0,0\n"), {"on one line"});
  refuses(shell + "*SHELL GENERAL SECTION, ELSET=E\n1e5,1e4,1e5\n", {"by its stiffnesses"});
  refuses(shell + "*SHELL SECTION, ELSET=E, NODAL THICKNESS\n*NODAL THICKNESS\n1,1\n",
          {"deck.inp:12:1", "node 2 has no *NODAL THICKNESS"});
  const std::string tet = with_nodes("*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1,2,3,5\n");
  refuses(tet +
              "*MATERIAL, NAME=L\n*ELASTIC, TYPE=LAMINA\n9,1,.3,1,1,1\n"
              "*SOLID SECTION, ELSET=E, MATERIAL=L\n",
          {"deck.inp:15:1", "TYPE=LAMINA", "ENGINEERING CONSTANTS"});
  refuses(with_nodes("*ELEMENT, TYPE=ROTARYI, ELSET=R\n1, 1\n*ROTARY INERTIA, ELSET=R\n1,1,1,5\n"),
          {"deck.inp:13:1", "principal moment of inertia", "negative"});
}

TEST_F(AbaqusMalformed, ConstraintsThatCannotBe) {
  refuses(with_nodes("*EQUATION\n3\n1,1,1.,2,1,-1.\n"),
          {"deck.inp:11:1", "expected 3 terms of the equation, found 2"});
  refuses(with_nodes("*EQUATION\n1\n1,1,1.,2,1,-1.\n"),
          {"expected 1 terms of the equation, found 2"});
  refuses(with_nodes("*EQUATION\n1000000000\n1,1,1.\n"), {"number of terms"});
  refuses(with_nodes("*EQUATION\n2\n1,7000,1.,2,1,-1.\n"), {"\"7000\" is not a degree"});
  refuses(with_nodes("*EQUATION\n2\n1,1,0.,2,1,-1.\n"), {"first coefficient is zero"});
  refuses(with_nodes("*MPC\nSLIDER, 1, 2, 3\n"), {"type \"SLIDER\" is not supported", "LINK"});
  refuses(with_nodes("*NODE\n9,0,0,0\n*MPC\nLINK, 1, 9\n"),
          {"deck.inp:13:1", "joins coincident nodes"});
  refuses(with_nodes("*MPC\nBEAM, 1\n"), {"expected two nodes"});
  refuses(with_nodes("*MPC\nPIN, 1, 1\n"), {"joins a node to itself"});
  refuses(with_nodes("*RIGID BODY, REF NODE=1\n"), {"needs ELSET"});
  refuses(with_nodes("*RIGID BODY, REF NODE=1, NSET=N\n"), {"no node set \"N\""});
  refuses(with_nodes("*COUPLING, CONSTRAINT NAME=C, REF NODE=1, SURFACE=S\n*NSET, NSET=A\n1\n"),
          {"followed by *KINEMATIC"});
  refuses(with_nodes("*KINEMATIC\n1,3\n"), {"below a *COUPLING"});
  refuses(with_nodes("*NSET, NSET=A\n*EQUATION\n2\nA,1,1.,2,1,-1.\n"), {"have 0 and 0 nodes"});
  refuses(with_nodes("*NSET, NSET=A\n*MPC\nPIN, A, A\n"), {"have 0 and 0 nodes"});
  refuses(with_nodes("*NSET, NSET=A, UNSORTED, GENERATE\n1, 3\n*MPC\nPIN, A, A\n"),
          {"deck.inp:10:1", "UNSORTED", "one by one"});
  const std::string surface = with_nodes("*SURFACE, NAME=S, TYPE=NODE\n2\n3\n4\n");
  refuses(with_nodes("*SURFACE, NAME=S, TYPE=NODE\n2, -1.\n"), {"deck.inp:11:1", "positive"});
  const std::string turned =
      surface + "*COUPLING, CONSTRAINT NAME=C, REF NODE=1, SURFACE=S, ORIENTATION=O\n";
  refuses(turned + "*KINEMATIC\n1, 2\n", {"deck.inp:14:1", "no orientation \"O\""});
  refuses(turned + "*DISTRIBUTING\n4, 4\n", {"deck.inp:14:1", "remove ORIENTATION"});
  refuses(turned + "*KINEMATIC\n1, 2\n*ORIENTATION, NAME=O, SYSTEM=SPHERICAL\n0,0,0,0,0,1\n",
          {"deck.inp:14:1", "expected RECTANGULAR or CYLINDRICAL"});
  refuses(turned + "*KINEMATIC\n1, 1\n*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n1,0,0,1,0,0\n",
          {"a and b coincide"});
  refuses(turned + "*KINEMATIC\n3, 1\n", {"deck.inp:16:1", "precedes the first"});
}

TEST_F(AbaqusMalformed, LargeSetsInManyTermsCostNoMemory) {
  std::string text = "*NODE, NSET=ALL\n";
  for (int k = 1; k <= 20000; ++k) text += fmt::format("{},{},0,0\n", k, k);
  text += "*EQUATION\n90000\n";
  for (int k = 0; k < 90000; ++k) text += "ALL,1,1.\n";
  refuses(text, {"deck.inp:20003:1", "join more than 20000000 nodes"});
}

}  // namespace
}  // namespace buckens::mesh_io
