// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/shards.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/sweep/parts.h"

namespace buckens::sweep {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;

TEST(Shards, AreWrittenAsParts) {
  const Shard shard = parse_shard("3/8");
  EXPECT_EQ(shard.index, 3);
  EXPECT_EQ(shard.count, 8);
  EXPECT_EQ(shard.name(), "3-of-8");
  for (const char* text : {"", "3", "0/4", "5/4", "-1/4", "1/0", "1/4/2", "a/b", "1 /4", "1/1e6"}) {
    EXPECT_THAT([&] { parse_shard(text); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("--shard"), HasSubstr("3/8"))))
        << text;
  }
}

TEST(Shards, HoldEveryVariantOnce) {
  for (const int count : {1, 2, 3, 7, 20}) {
    const std::vector<int> groups = {0, 1, 0, 2, 1, 1, 3, 0, 2, 0, 4};
    std::multiset<std::size_t> seen;
    for (const auto& shard : divide_into_shards(groups, count)) {
      seen.insert(shard.begin(), shard.end());
    }
    EXPECT_EQ(seen.size(), groups.size()) << count;
    EXPECT_EQ(std::set<std::size_t>(seen.begin(), seen.end()).size(), groups.size()) << count;
  }
  EXPECT_THAT(divide_into_shards({}, 3), AllOf(SizeIs(3), Each(SizeIs(0))));
}

TEST(Shards, KeepGroupsWholeThatFit) {
  // Alternating matrices: each shard gets all of one kind.
  EXPECT_THAT(divide_into_shards({0, 1, 0, 1, 0, 1}, 2),
              ElementsAre(ElementsAre(0, 2, 4), ElementsAre(1, 3, 5)));
  // Five and three: the cut moves to the end of the group.
  EXPECT_THAT(divide_into_shards({0, 0, 0, 1, 1, 1, 1, 1}, 2),
              ElementsAre(SizeIs(4), SizeIs(4)));  // the group of five is larger than a shard
  EXPECT_THAT(divide_into_shards({0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2}, 2),
              ElementsAre(ElementsAre(0, 1, 2, 3, 4), SizeIs(6)));
}

TEST(Shards, DivideAGroupThatIsTooLarge) {
  const auto shards = divide_into_shards(std::vector<int>(10, 0), 4);
  EXPECT_THAT(shards, ElementsAre(SizeIs(2), SizeIs(3), SizeIs(2), SizeIs(3)));
}

constexpr char kModel[] = R"(buckens: 1
parameters: {E: 200 GPa, g: 9.81 m/s^2}
gravity: [0, -g, 0]
materials: {steel: {E: E, nu: 0.3, rho: 7850}}
bodies: {rod: {beam: {to: [1 m, 0, 0], elements: 2, section: {circle: {diameter: 8 mm}}, material: steel}}}
joints: {pin: {spherical: {between: [ground, rod/start]}}}
simulation: {duration: 1 ms, step: 0.5 ms}
)";

class StudyFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "rod.yaml") << kModel;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::vector<int> groups(const std::vector<std::string>& ranges) {
    return matrix_groups(folder_ / "rod.yaml", {}, combinations(ranges));
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("study_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(StudyFolder, GroupsFollowTheContentOfMatrices) {
  EXPECT_THAT(groups({"parameters.g=[9.81 m/s^2, 1.62 m/s^2]", "parameters.E=[200 GPa, 70 GPa]"}),
              ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(groups({"simulation.step=[0.5 ms, 0.25 ms]"}), ElementsAre(0, 1));
  // The same matrices, however written: the same group.
  EXPECT_THAT(groups({"parameters.E=[200 GPa, 2e11 Pa]"}), ElementsAre(0, 0));
  // A variant that cannot be built is told when it is run.
  EXPECT_THAT(groups({"parameters.g=[9.81, fast]"}), SizeIs(2));
}

class Parts : public StudyFolder {
 protected:
  void write(int index, int count, const std::string& study = "s") {
    SummaryTable summary;
    summary.add_row({{"name", "v" + std::to_string(index)},
                     {"status", index == 2 ? "failed" : "done"},
                     {"message", index == 2 ? "no, \"never\"" : ""},
                     {"x [m] last", std::to_string(index) + ".5"}});
    // From the last to the first: the table has its own order.
    write_part(folder_, {index, count}, study, {static_cast<std::size_t>(count - index)}, summary,
               {});
  }
  void refuses(const std::string& words) {
    EXPECT_THAT([&] { merge_parts(folder_); }, ThrowsMessage<Error>(HasSubstr(words)));
  }
};

TEST_F(Parts, MakeATableInItsOrder) {
  for (int k = 1; k <= 3; ++k) write(k, 3);
  write(2, 3);  // again
  const MergedSweep merged = merge_parts(folder_);
  EXPECT_EQ(merged.summary.csv(),
            "name,status,message,x [m] last\nv3,done,,3.5\nv2,failed,\"no, \"\"never\"\"\",2.5\n"
            "v1,done,,1.5\n");
  EXPECT_EQ(merged.variants[1].status, VariantStatus::failed);
  EXPECT_EQ(merged.variants[1].message, "no, \"never\"");
  merged.summary.write_hdf5(folder_ / "sweep.h5");
  EXPECT_GT(std::filesystem::file_size(folder_ / "sweep.h5"), 1000U);
}

TEST_F(Parts, ThatDoNotBelongTogetherAreRefused) {
  refuses("no parts of a sweep");
  write(2, 3);
  refuses("1/3, 3/3");
  write(1, 4);
  refuses("remove the files of the unwanted division");
  std::filesystem::remove(folder_ / kPartsName / "1-of-4.json");
  write(1, 3, "another");
  refuses("another model or table");
  write(1, 3);
  std::ofstream(folder_ / kPartsName / "3-of-3.json") << "{\"shard\": 3,";
  refuses("damaged; remove it");
}

}  // namespace
}  // namespace buckens::sweep
