// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/channel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/results/table.h"

namespace buckens::results {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Channel channel(std::string path, std::vector<int> shape = {}) {
  return {.path = std::move(path),
          .unit = "m",
          .shape = std::move(shape),
          .description = {},
          .components = {}};
}

TEST(RecordLayout, PlacesChannelsOneBehindTheOther) {
  RecordLayout layout;
  EXPECT_EQ(layout.add(channel("energies/kinetic")), 0U);
  EXPECT_EQ(layout.add(channel("bodies/rod/displacement", {4, 6})), 1U);
  EXPECT_EQ(layout.add(channel("sensors/tip", {3})), 2U);
  EXPECT_EQ(layout.offset(0), 0U);
  EXPECT_EQ(layout.offset(1), 1U);
  EXPECT_EQ(layout.offset(2), 25U);
  EXPECT_EQ(layout.num_values(), 28U);
  EXPECT_EQ(layout.find("sensors/tip"), 2);
  EXPECT_EQ(layout.find("sensors/top"), -1);
}

TEST(RecordLayout, RefusesPathsWithoutAPlaceInAFile) {
  for (const char* path : {"", "/tip", "tip/", "a//b", ".", "a/../b", "a/."}) {
    RecordLayout layout;
    EXPECT_THAT([&] { layout.add(channel(path)); }, ThrowsMessage<ModelError>(HasSubstr("Rename")))
        << path;
  }
}

TEST(RecordLayout, RefusesNamesInTheWayOfEachOther) {
  RecordLayout layout;
  layout.add(channel("a/b"));
  layout.add(channel("a/bc"));  // shares letters, not the place
  for (const char* path : {"a/b", "a", "a/b/c"}) {
    EXPECT_THAT([&] { layout.add(channel(path)); },
                ThrowsMessage<ModelError>(HasSubstr("the name is taken")))
        << path;
  }
}

TEST(RecordLayout, RefusesShapesWithoutValuesAndWrongComponents) {
  RecordLayout layout;
  EXPECT_THROW(layout.add(channel("none", {0})), ModelError);
  Channel two_names = channel("force", {3});
  two_names.components = {"x", "y"};
  EXPECT_THROW(layout.add(two_names), ModelError);
}

TEST(Table, KeepsRecordsByChannel) {
  RecordLayout layout;
  layout.add(channel("a"));
  layout.add(channel("b", {2}));
  Table table;
  table.begin(layout, {});
  table.write({0.0, {1, 2, 3}});
  table.write({0.5, {4, 5, 6}});
  EXPECT_FALSE(table.summary().has_value());
  RunSummary summary;
  summary.title = "two records";
  table.finish(summary);
  EXPECT_EQ(table.summary()->title, "two records");
  EXPECT_EQ(table.times(), (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(table.values("b"), (Eigen::Matrix2d() << 2, 3, 5, 6).finished());
  EXPECT_THROW(table.values("c"), ModelError);
  EXPECT_THROW(table.write({1.0, {1}}), ModelError);
}

}  // namespace
}  // namespace buckens::results
