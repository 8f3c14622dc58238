// SPDX-License-Identifier: Apache-2.0
// Fields over meshes in results.h5.
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/exports/csv.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/run_snapshot.h"
#include "buckens/run_store/test/sample_fields.h"

namespace buckens::exports {
namespace {

using buckens::test::TemporaryDirectory;
using run_store::test::field_record;
using run_store::test::fields_geometry;
using run_store::test::finished_summary;
using run_store::test::kLargest;
using run_store::test::kMises;
using run_store::test::kStress;
using run_store::test::sample_fields;
using run_store::test::sample_layout;
using run_store::test::write_fields_run;

TEST(RunFields, ComeBackWithTheirOwnClock) {
  const TemporaryDirectory directory;
  write_fields_run(directory / "out", 250);
  const run_store::RunReader run(directory / "out");
  EXPECT_EQ(run.num_records(), 250U);
  ASSERT_EQ(run.field_times().size(), 84U);
  for (std::size_t row = 0; row < 84; ++row) {
    EXPECT_EQ(run.field_times()[row], run.times()[3 * row]);  // to the bit
    EXPECT_EQ(run.record_of_field(row), 3 * row);
  }
  // Fields do not appear among the channels of the records.
  EXPECT_EQ(run.layout().channels().size(), sample_layout().channels().size());
  const results::Channel* stress = run_store::find_channel(run.field_layout(), kStress);
  ASSERT_NE(stress, nullptr);
  EXPECT_EQ(stress->shape, (std::vector<int>{1, 6}));
  EXPECT_EQ(stress->unit, "Pa");
  EXPECT_EQ(stress->components[5], "zx");
  const double t = run.field_times()[7];
  const std::vector<double> mises = run.read_fields(kMises, std::array<std::size_t, 1>{7});
  ASSERT_EQ(mises.size(), 4U);
  EXPECT_NEAR(mises[3], 4 + t, 1e-6);  // single precision in the file
  EXPECT_TRUE(std::isnan(mises[2]));
  EXPECT_NEAR(run.read_fields(kStress, std::array<std::size_t, 1>{7})[5], 50 + t, 1e-5);
  EXPECT_EQ(run.read_fixed(kLargest), (std::vector<double>{5, 6, 7, 8}));
  EXPECT_EQ(run.read_fixed(std::string(kLargest) + "_time"),
            (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
  EXPECT_TRUE(run.read_fixed("extremes/bodies/slider/nodes/von_mises").empty());
}

TEST(RunFields, PlacesComeBack) {
  const TemporaryDirectory directory;
  write_fields_run(directory / "out", 4);
  const results::GeometryBody rod = run_store::RunReader(directory / "out").geometry().bodies[1];
  const results::GeometryBody known = fields_geometry().bodies[1];
  EXPECT_EQ(rod.cell_kinds, known.cell_kinds);
  EXPECT_EQ(rod.cell_nodes, known.cell_nodes);
  EXPECT_EQ(rod.field_nodes, known.field_nodes);
  EXPECT_EQ(rod.field_elements, known.field_elements);
  EXPECT_EQ(rod.face_places, known.face_places);
  EXPECT_EQ(rod.cell_places, known.cell_places);
}

TEST(RunFields, RunsWithoutFieldsHaveNone) {
  const TemporaryDirectory directory;
  {
    run_store::RunDirectory run(directory / "out", {.title = "", .model_text = "", .flush = {}});
    run.begin(sample_layout(), run_store::test::sample_geometry());
    EXPECT_THROW(run.write_fields(field_record(0)), IoError);
    run.finish(finished_summary());
  }
  const run_store::RunReader run(directory / "out");
  EXPECT_TRUE(run.field_times().empty());
  EXPECT_TRUE(run.field_layout().channels().empty());
}

TEST(RunFields, WrongNumbersOfValuesAreRefused) {
  const TemporaryDirectory directory;
  run_store::RunDirectory run(directory / "out", {.title = "", .model_text = "", .flush = {}});
  run.begin_fields(sample_fields());
  run.begin(sample_layout(4), fields_geometry());
  EXPECT_THAT(
      [&] {
        run.write_fields({0.0, {1, 2}});
      },
      testing::ThrowsMessage<IoError>(testing::HasSubstr("2 values for channels")));
}

TEST(RunFields, InstantsAreThoseOfTheFields) {
  const TemporaryDirectory directory;
  write_fields_run(directory / "out", 10);  // records 0 … 9, fields at 0, 3, 6, 9
  const run_store::RunReader run(directory / "out");
  const std::vector<run_store::Instant> all = run_store::choose_instants(run, {});
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[1].record, 3U);
  EXPECT_EQ(all[1].field_row, 1U);
  run_store::InstantChoice two;
  two.count = 2;
  EXPECT_EQ(run_store::choose_instants(run, two).back().record, 9U);
  run_store::InstantChoice near;
  near.times = {run.times()[5], run.times()[6]};  // both are nearest to the third of the fields
  ASSERT_EQ(run_store::choose_instants(run, near).size(), 1U);
  near.times = {17.0};
  EXPECT_THAT([&] { run_store::choose_instants(run, near); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("no instant 17 s")));
}

TEST(RunFields, BecomeTables) {
  const TemporaryDirectory directory;
  write_fields_run(directory / "out", 4);
  const std::vector<std::string> files =
      export_csv(run_store::RunReader(directory / "out"), {}, directory / "csv");
  EXPECT_THAT(files, testing::ElementsAre("sensors.csv", "rod_nodes.csv", "rod_nodes_extremes.csv",
                                          "rod_elements.csv"));
  EXPECT_EQ(files::read_text_file(directory / "csv/sensors.csv").substr(0, 23),
            "t [s],tip.x [m],tip.y [");
  const std::string nodes = files::read_text_file(directory / "csv/rod_nodes.csv");
  EXPECT_EQ(nodes.substr(0, nodes.find('\n', nodes.find('\n') + 1)),
            "t [s],node,x [m],y [m],z [m],von_mises [Pa]\n0,1,0,0,0,1");
  EXPECT_THAT(nodes, testing::HasSubstr("\n0,2,1,0,0,\n"));  // no value
  EXPECT_EQ(files::read_text_file(directory / "csv/rod_nodes_extremes.csv"),
            "node,x [m],y [m],z [m],von_mises [Pa],at [s]\n1,0,0,0,5,0.1\n2,1,0,0,6,0.2\n"
            "2,1,0,0,7,0.3\n4,0,0,1,8,0.4\n");
  EXPECT_THAT(files::read_text_file(directory / "csv/rod_elements.csv"),
              testing::StartsWith("t [s],element,stress.xx [Pa],"));
}

}  // namespace
}  // namespace buckens::exports
