// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/mesh_io/matrix/body.h"
#include "buckens/mesh_io/matrix/file.h"

namespace buckens::mesh_io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Two nodes with three displacements each, joined by a spring of 5 along the line between them.
const char* const kMass =
    "%%MatrixMarket matrix coordinate real symmetric\n% masses\n6 6 6\n"
    "1 1 2.0\n2 2 2.0\n3 3 2.0\n4 4 3.0\n5 5 3.0\n6 6 3.0\n";
const char* const kStiffness =
    "%%MatrixMarket matrix coordinate real symmetric\n6 6 3\n1 1 5.0\n4 1 -5.0\n4 4 5.0\n";
const char* const kNodeTable = "node,x,y,z\n7,0,0,0\n3,1,0,0\n";

class MatrixBody : public testing::Test {
 protected:
  MatrixBody() {
    write("m.mtx", kMass);
    write("k.mtx", kStiffness);
    write("nodes.csv", kNodeTable);
    spec_.mass = "m.mtx";
    spec_.stiffness = "k.mtx";
    spec_.nodes = "nodes.csv";
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  fem::BodyMatrices read() const { return *read_body_matrices(spec_, folder_.path()); }

  void refuses(const std::vector<std::string>& words) const {
    try {
      read();
    } catch (const InputError& error) {
      for (const std::string& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
      return;
    }
    ADD_FAILURE() << "nothing was refused, expected: " << words.front();
  }

  buckens::test::TemporaryDirectory folder_;
  fem::MatricesSpec spec_;
};

TEST_F(MatrixBody, RowsFollowTheTable) {
  const fem::BodyMatrices body = read();
  ASSERT_EQ(body.nodes.size(), 2u);
  EXPECT_EQ(body.nodes[0].name, "n7");
  EXPECT_EQ(body.numbers[1], 3);
  EXPECT_EQ(body.nodes[1].position.x(), 1.0);
  EXPECT_EQ(body.dofs.num_dofs, 6);
  EXPECT_EQ(body.M.coeff(4, 4), 3.0);
  EXPECT_EQ(body.K.coeff(0, 3), -5.0);  // the other triangle
  EXPECT_EQ(body.C.nonZeros(), 0);
}

TEST_F(MatrixBody, TheTableMaySayWhichRowIsWhat) {
  write("nodes.csv",
        "# rows of the second program\nnode;x;y;z;uz;uy;ux\n7;0;0;0;3;2;4\n3;1;0;0;6;5;1\n");
  const fem::BodyMatrices body = read();
  EXPECT_EQ(body.M.coeff(0, 0), 3.0);  // row 4 of the file is ux of node 7
  EXPECT_EQ(body.M.coeff(3, 3), 2.0);
  EXPECT_EQ(body.K.coeff(0, 3), -5.0);
}

TEST_F(MatrixBody, FullAndDenseMatricesAreReadAsWell) {
  const fem::BodyMatrices body = read();
  write("k.mtx",
        "%%MatrixMarket matrix coordinate real general\n6 6 4\n1 1 5\n4 1 -5\n1 4 -5\n4 4 5\n");
  EXPECT_EQ((read().K - body.K).norm(), 0.0);
  std::string dense = "%%MatrixMarket matrix array real general\n6 6\n";
  for (int column = 0; column < 6; ++column) {
    for (int row = 0; row < 6; ++row) dense += std::to_string(body.K.coeff(row, column)) + "\n";
  }
  write("k.mtx", dense);
  EXPECT_EQ((read().K - body.K).norm(), 0.0);
  dense = "%%MatrixMarket matrix array real symmetric\n6 6\n";
  for (int column = 0; column < 6; ++column) {
    for (int row = column; row < 6; ++row) dense += std::to_string(body.K.coeff(row, column)) + " ";
  }
  write("k.mtx", dense);
  EXPECT_EQ((read().K - body.K).norm(), 0.0);
}

TEST_F(MatrixBody, MatricesOfAbaqusAreToldByTheirContent) {
  const fem::BodyMatrices body = read();
  write("k.mtx", "** Stiffness\n7,1, 7,1,  5.0e+00\n3,1, 7,1, -5.0e+00\n3,1, 3,1,  5.0e+00\n");
  write("m.mtx", "7,1,7,1,2.\n7,2,7,2,2.\n7,3,7,3,2.\n3,1,3,1,3.\n3,2,3,2,3.\n3,3,3,3,3.\n");
  const fem::BodyMatrices labelled = read();
  EXPECT_EQ((labelled.K - body.K).norm(), 0.0);
  EXPECT_EQ((labelled.M - body.M).norm(), 0.0);
  // One matrix with labels and one with counted rows go together.
  write("m.mtx", kMass);
  EXPECT_EQ((read().M - body.M).norm(), 0.0);
  // FORMAT=COORDINATE, and what CalculiX writes.
  write("k.mtx", "1 1 5.\n1 4 -5.\n4 1 -5.\n4 4 5.\n6 6 0.\n");
  EXPECT_EQ((read().K - body.K).norm(), 0.0);
}

TEST_F(MatrixBody, ATriangleInTheOrderOfTheProgramIsATriangle) {
  // Numbers of nodes rise and fall along the rows of the lower triangle.
  write("nodes.csv", "node,x,y,z,ux,uy,uz\n7,0,0,0,1,2,3\n3,1,0,0,4,5,6\n5,2,0,0,7,8,9\n");
  std::string mass;
  for (const char* node : {"7", "3", "5"}) {
    for (const char* dof : {"1", "2", "3"}) {
      mass += std::string(node) + "," + dof + "," + node + "," + dof + ",2.\n";
    }
  }
  write("m.mtx", mass);
  write("k.mtx", "7,1,7,1,2.\n3,1,7,1,-1.\n3,1,3,1,2.\n5,1,3,1,-1.\n5,1,5,1,2.\n");
  const fem::BodyMatrices body = read();
  EXPECT_EQ(body.K.coeff(0, 3), -1.0);
  EXPECT_EQ(body.K.coeff(3, 0), -1.0);
  EXPECT_EQ(body.K.coeff(3, 6), -1.0);
  EXPECT_EQ(body.K.coeff(6, 3), -1.0);
  // One entry on the other side makes it a full matrix, in which another one is missing.
  write("k.mtx", "7,1,7,1,2.\n3,1,7,1,-1.\n7,1,3,1,-1.\n3,1,3,1,2.\n5,1,3,1,-1.\n5,1,5,1,2.\n");
  refuses({"k.mtx", "not symmetric", "-1"});
}

TEST_F(MatrixBody, FilesMayBeginWithAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  const fem::BodyMatrices body = read();
  write("nodes.csv", mark + kNodeTable);
  write("k.mtx", mark + kStiffness);
  const fem::BodyMatrices marked = read();
  EXPECT_EQ(marked.numbers, body.numbers);
  EXPECT_EQ((marked.K - body.K).norm(), 0.0);
}

TEST_F(MatrixBody, UnitsOfLengthAndMassAreTurnedIntoMetresAndKilograms) {
  write("nodes.csv", "node,x,y,z,ux,uy,uz,rx,ry,rz\n7,1000,0,0,1,2,3,4,5,6\n");
  spec_.length_unit = fem::LengthUnit::mm;
  const fem::BodyMatrices body = read();
  EXPECT_DOUBLE_EQ(body.nodes[0].position.x(), 1.0);
  // Tonnes go with millimetres: t → kg, t mm² → kg m².
  EXPECT_DOUBLE_EQ(body.M.coeff(0, 0), 2000.0);
  EXPECT_DOUBLE_EQ(body.M.coeff(3, 3), 3000.0 * 1e-6);
  EXPECT_DOUBLE_EQ(body.K.coeff(0, 3), -5000.0 * 1e-3);
  spec_.mass_unit = fem::MassUnit::kg;
  EXPECT_DOUBLE_EQ(read().M.coeff(0, 0), 2.0);
}

TEST_F(MatrixBody, MalformedMatricesAreRefusedWithFileAndLine) {
  const auto with = [&](const std::string& text, const std::vector<std::string>& words) {
    write("k.mtx", text);
    refuses(words);
  };
  with("", {"k.mtx", "empty"});
  with("%%MatrixMarket matrix coordinate complex symmetric\n1 1 1\n1 1 1 1\n",
       {"k.mtx:1:1", "complex"});
  with("%%MatrixMarket matrix coordinate real skew-symmetric\n", {"skew-symmetric"});
  with("%%MatrixMarket vector\n", {"expected a line such as"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 6\n1 1 1\n", {"k.mtx:2:1", "entries"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 5 1\n1 1 1\n", {"not square"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 6 9\n1 1 1\n",
       {"9 entries are announced but 1 found"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 6 1\n7 1 1\n",
       {"k.mtx:3:1", "row", "1 to 6"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 6 1\n1 1 nan\n", {"k.mtx:3:1", "nan"});
  with("%%MatrixMarket matrix coordinate real symmetric\n99999999999 99999999999 1\n1 1 1\n",
       {"number of rows"});
  with("%%MatrixMarket matrix array real general\n6 6\n1 2 3\n", {"column 1 of 6", "truncated"});
  with("%%MatrixMarket matrix coordinate real general\n6 6 2\n1 2 5\n2 1 4\n", {"not symmetric"});
  with("%%MatrixMarket matrix coordinate real symmetric\n9 9 1\n1 1 1\n", {"9 rows"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 6 3\n1 1 5\n4 1 -5\n1 4 -5\n",
       {"k.mtx:5:1", "both sides", "general"});
  with("%%MatrixMarket matrix coordinate real symmetric\n6 6 1\n1 x 1\n", {"k.mtx:3:1", "\"x\""});
  with("1,1,1,1\n", {"found 4 values"});
  with("1 1 5.0\n1 1\n", {"k.mtx:2:1", "2 values"});
  with("7,1,7,8,1.0\n", {"degree of freedom", "\"8\""});
  with("-1,1,7,1,1.0\n", {"internal nodes"});
  with("8,1,8,1,1.0\n", {"k.mtx:1:1", "node 8 is not in the table"});
  with("7,4,7,4,1.0\n7,1,7,1,1.\n", {"rx of node 7 is not among the variables"});
  with("1 1 5\n" + std::string(1, '\0'), {"not text"});
  spec_.stiffness = "missing.mtx";
  EXPECT_THROW(read(), IoError);
}

TEST_F(MatrixBody, GarbageAndTornFilesEndInAMessage) {
  std::string garbage;
  unsigned state = 1;
  for (int k = 0; k < 20000; ++k) {
    state = state * 1664525u + 1013904223u;
    garbage.push_back(static_cast<char>(1 + (state >> 24) % 255));
  }
  const std::string good = "%%MatrixMarket matrix coordinate real symmetric\n6 6 2\n1 1 5\n4 4 5\n";
  for (const std::string& text : {garbage, "%%MatrixMarket " + garbage, good + garbage}) {
    write("k.mtx", text);
    EXPECT_THROW(read(), InputError);
  }
  // Whatever is missing at the end, but for the line end and the last digits of a number.
  for (std::size_t size = 0; size + 2 < good.size(); ++size) {
    write("k.mtx", good.substr(0, size));
    EXPECT_THROW(read(), InputError) << size;
  }
  write("k.mtx", good);
  read();
  write("nodes.csv", garbage);
  EXPECT_THROW(read(), InputError);
}

TEST_F(MatrixBody, MalformedTablesAreRefusedWithFileAndLine) {
  const auto with = [&](const std::string& text, const std::vector<std::string>& words) {
    write("nodes.csv", text);
    refuses(words);
  };
  with("", {"empty"});
  with("node,x,y\n", {"nodes.csv:1:1", "\"z\""});
  with("node,x,y,zz\n", {"\"zz\" is not a column", "\"z\""});
  with("node,x,y,z\n7,0,0\n", {"nodes.csv:2:1", "3 cells, the heading 4"});
  with("node,x,y,z\n7,0,0,inf\n", {"inf"});
  with("node,x,y,z\n7,0,0,0\n7,1,0,0\n", {"nodes.csv:3:1", "twice"});
  with("node,x,y,z\n99999999999,0,0,0\n", {"99999999999"});
  with("node,x,y,z\n7,0,0,0\n3,1,0,0\n9,2,0,0\n", {"6 rows, the table 3 nodes"});
  with("node,x,y,z,ux,uy,uz\n7,0,0,0,1,2,3\n3,1,0,0,4,5,9\n", {"nodes.csv:3:1", "row 9"});
  with("node,x,y,z,ux,uy,uz\n7,0,0,0,1,2,3\n3,1,0,0,4,5,1\n", {"row 1 is named twice"});
  with("node,x,y,z,ux,uy,uz\n7,0,0,0,1,2,3\n3,1,0,0,4,5,\n", {"node 3", "uz"});
}

}  // namespace
}  // namespace buckens::mesh_io
