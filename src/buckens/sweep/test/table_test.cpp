// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/table.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/files/csv_row.h"

namespace buckens::sweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class SweepTableFile : public testing::Test {
 protected:
  SweepTable read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_sweep_table(file_);
  }
  void refuses(const std::string& text, const std::string& line, const std::string& words) {
    EXPECT_THAT([&] { read(text); },
                ThrowsMessage<InputError>(testing::AllOf(HasSubstr(line), HasSubstr(words))))
        << text;
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("sweep_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".csv");
};

TEST_F(SweepTableFile, RowsBecomeOverrides) {
  const SweepTable table = read(
      "\xEF\xBB\xBF# speeds\n"
      "name, parameters.speed ,bodies.block.mesh.box.divisions\r\n"
      "\n"
      "slow,100 rad/s,\"[36, 2, 2]\"\n"
      "fast-1,150,\"[\"\"a\"\"]\"\n");
  EXPECT_THAT(table.paths, ElementsAre("parameters.speed", "bodies.block.mesh.box.divisions"));
  ASSERT_EQ(table.variants.size(), 2U);
  EXPECT_EQ(table.variants[0].name, "slow");
  EXPECT_THAT(
      table.overrides(table.variants[0]),
      ElementsAre("parameters.speed=100 rad/s", "bodies.block.mesh.box.divisions=[36, 2, 2]"));
  EXPECT_THAT(table.variants[1].values, ElementsAre("150", "[\"a\"]"));
}

TEST_F(SweepTableFile, NumbersVariantsWithoutNames) {
  const SweepTable table = read("a\n1\n2\n");
  EXPECT_EQ(table.variants[0].name, "001");
  EXPECT_EQ(table.variants[1].name, "002");
}

TEST_F(SweepTableFile, RefusesWhatCannotBe) {
  refuses("", ".csv", "has no variants");
  refuses("a,b\n", ".csv", "has no variants");
  refuses("a,b\n1\n", ".csv:2", "has 1 cells, the first line has 2");
  refuses("a,a\n1,2\n", ".csv:1", "appears twice");
  refuses("a=1,b\n1,2\n", ".csv:1", "not a path");
  refuses("name,a\nx,1\nx,2\n", ".csv:3", "\"x\" appears twice");
  refuses("name,a\n../x,1\n", ".csv:2", "cannot name a run directory");
  refuses("name,a\n,1\n", ".csv:2", "cannot name a run directory");
  refuses("name,a\nsweep.csv,1\n", ".csv:2", "the name of the table that the sweep writes");
  refuses("a\n\"1\n", ".csv:2", "not closed");
  EXPECT_THROW(read_sweep_table("no/such/file.csv"), IoError);
}

TEST(SweepCombinations, LastPathVariesFastest) {
  const SweepTable table = combinations({"a=[1, 2 mm]", "b.c=[[3, 4], {x: y}, off]"});
  EXPECT_THAT(table.paths, ElementsAre("a", "b.c"));
  ASSERT_EQ(table.variants.size(), 6U);
  EXPECT_THAT(table.variants[0].values, ElementsAre("1", "[3, 4]"));
  EXPECT_THAT(table.variants[1].values, ElementsAre("1", "{x: y}"));
  EXPECT_THAT(table.variants[5].values, ElementsAre("2 mm", "off"));
  EXPECT_EQ(table.variants[5].name, "006");
}

TEST(SweepCombinations, RefusesWhatIsNoRange) {
  for (const char* text : {"a", "=[1]", "a=1", "a=[]", "a=[1", "a={b: 1}"}) {
    EXPECT_THAT([&] { combinations({text}); },
                ThrowsMessage<InputError>(HasSubstr("write PATH=[VALUE")))
        << text;
  }
  EXPECT_THROW(combinations({"a=[1]", "a=[2]"}), InputError);
  const std::string many = "=[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20]";
  EXPECT_THAT(
      [&] {
        combinations({"a" + many, "b" + many, "c" + many, "d" + many});
      },
      ThrowsMessage<InputError>(HasSubstr("more than 100000 variants")));
}

TEST(CsvRow, CellsComeBackAsTheyWere) {
  for (const std::string text : {"plain", "a,b", "say \"x\"", ""}) {
    const auto cells = files::split_csv_row(files::csv_cell(text) + ",end");
    ASSERT_TRUE(cells);
    EXPECT_THAT(*cells, ElementsAre(text, "end"));
  }
}

}  // namespace
}  // namespace buckens::sweep
