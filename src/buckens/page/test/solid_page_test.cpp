// SPDX-License-Identifier: Apache-2.0
// Solids in results.h5 and in the page.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/base/test/temporary_directory.h"
#include "buckens/files/output_file.h"
#include "buckens/page/rows.h"
#include "buckens/page/test/page_values.h"
#include "buckens/page/view_page.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::page {
namespace {

using run_store::test::sample_record;
using run_store::test::sample_value;
using test::decode;
using test::decode_codes;
using test::decode_ints;

constexpr int kNodes = 27;
constexpr std::size_t kRecords = 5;

/// A cube of 2 × 2 × 2 elements of which two faces are drawn, of elements 0 and 5; a marker sits on
/// the node in the middle.
results::Geometry cube() {
  results::Geometry out;
  results::GeometryBody body;
  body.name = "cube";
  body.kind = results::BodyKind::solid;
  body.nodes.resize(kNodes, 3);
  for (int n = 0; n < kNodes; ++n) body.nodes.row(n) << n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1;
  body.faces = {{0, 3, 4, 1}, {19, 20, 23, -1}};
  body.face_elements = {0, 5};
  body.markers.push_back({"centre", 13, {}});
  out.bodies = {body};
  return out;
}

results::RecordLayout cube_layout() {
  results::RecordLayout layout;
  layout.add({"bodies/cube/displacement", "m, rad", {kNodes, 6}, "nodal displacements", {}});
  layout.add({"bodies/cube/pose", "m, 1", {7}, "pose of the body frame", {}});
  layout.add({"bodies/cube/solid_stress", "Pa", {8}, "von Mises stress", {}});
  return layout;
}

class SolidPage : public testing::Test {
 protected:
  SolidPage() {
    run_store::RunDirectory run(directory_ / "out",
                                {.title = "cube", .model_text = "", .flush = {}});
    run.begin(cube_layout(), cube());
    for (std::size_t i = 0; i < kRecords; ++i) {
      run.write(sample_record(i, cube_layout().num_values()));
    }
    run.finish(run_store::test::finished_summary());
  }

  nlohmann::json body(const ViewPageOptions& options = {}) {
    files::replace_text_file(directory_ / "template.html", "/*BUCKENS_DATA*/null");
    report_ = write_view_page({directory_ / "out"}, directory_ / "template.html",
                              directory_ / "page.html", options)
                  .at(0);
    const nlohmann::json page =
        nlohmann::json::parse(files::read_text_file(directory_ / "page.html"));
    return page["runs"][0]["bodies"][0];
  }

  buckens::test::TemporaryDirectory directory_;
  ViewPageReport report_;
};

TEST_F(SolidPage, RunDirectoriesKeepTheSurface) {
  const results::GeometryBody read =
      run_store::RunReader(directory_ / "out").geometry().bodies.at(0);
  EXPECT_EQ(read.kind, results::BodyKind::solid);
  EXPECT_EQ(read.faces, cube().bodies[0].faces);
  EXPECT_EQ(read.face_elements, cube().bodies[0].face_elements);
  EXPECT_TRUE(read.elements.empty());
}

TEST_F(SolidPage, HoldsWhatCanBeSeenOnly) {
  const nlohmann::json page = body();
  EXPECT_EQ(page["kind"], "solid");
  // Nodes 0, 1, 3, 4 of the first face, 19, 20, 23 of the second, 13 for the marker.
  EXPECT_EQ(decode_ints(page["nodeNumbers"]), (std::vector<int>{0, 1, 3, 4, 13, 19, 20, 23}));
  ASSERT_EQ(decode(page["nodes"]).size(), 24U);
  EXPECT_EQ(decode(page["nodes"])[12], 0.0F);
  EXPECT_EQ(decode_ints(page["faces"]), (std::vector<int>{0, 2, 3, 1, 5, 6, 7, -1}));
  EXPECT_EQ(decode_ints(page["faceElements"]), (std::vector<int>{0, 1}));
  EXPECT_EQ(page["markers"][0]["node"], 4);
  const std::vector<float> moved = decode(page["displacement"]["values"]);
  ASSERT_EQ(moved.size(), kRecords * 8U * 3U);
  // Second record, node 13, y.
  EXPECT_EQ(moved[24 + 3 * 4 + 1], static_cast<float>(sample_value(1, 6 * 13 + 1)));
  ASSERT_EQ(page["fields"].size(), 1U);
  EXPECT_EQ(page["fields"][0]["name"], "von_mises");
  EXPECT_EQ(page["fields"][0]["on"], "elements");
  const std::vector<float> stress = decode(page["fields"][0]["values"]["values"]);
  ASSERT_EQ(stress.size(), kRecords * 2U);
  EXPECT_EQ(stress[3], static_cast<float>(sample_value(1, 6 * kNodes + 7 + 5)));
}

TEST_F(SolidPage, RoundsToSixteenBitsWhereItMust) {
  // Pose 7 and the time stay float32, 24 displacements and two stresses take two bytes each, the
  // ends of the two ranges four numbers.
  const nlohmann::json page = body({.max_frames = 2000, .max_bytes = 3 * (12 * 4 + 26 * 2)});
  EXPECT_EQ(report_.frames, 3U);
  EXPECT_TRUE(report_.rounded);
  const nlohmann::json& rows = page["displacement"];
  EXPECT_EQ(rows["type"], "u16");
  const std::vector<float> ranges = decode(rows["ranges"]);
  ASSERT_EQ(ranges.size(), 6U);
  const std::vector<std::uint16_t> codes = decode_codes(rows["values"]);
  ASSERT_EQ(codes.size(), 3U * 24U);
  // The last record, node 13, y: half a step of the range, and float32 of its ends.
  const double exact = sample_value(kRecords - 1, 6 * 13 + 1);
  const double range = static_cast<double>(ranges[5]) - static_cast<double>(ranges[4]);
  const double found = static_cast<double>(ranges[4]) + codes[2 * 24 + 3 * 4 + 1] * range / 65534;
  EXPECT_NEAR(found, exact, 0.5 * range / 65534 + 1e-6);
}

TEST(PageRows, MarkWhatIsMissing) {
  PageRowsWriter writer(true);
  writer.add(std::vector<double>{1.0, std::nan(""), 3.0});
  writer.add(std::vector<double>{std::nan(""), HUGE_VAL, std::nan("")});
  writer.add(std::vector<double>{7.0, 7.0, 7.0});
  const nlohmann::json rows = writer.json();
  EXPECT_EQ(decode_codes(rows["values"]),
            (std::vector<std::uint16_t>{0, 65535, 65534, 65535, 65535, 65535, 0, 0, 0}));
  EXPECT_EQ(decode(rows["ranges"]), (std::vector<float>{1, 3, 0, 0, 7, 7}));
}

}  // namespace
}  // namespace buckens::page
