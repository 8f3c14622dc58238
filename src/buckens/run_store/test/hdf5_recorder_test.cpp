// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_recorder.h"

#include <gtest/gtest.h>

#include "buckens/base/test/temporary_directory.h"
#include "buckens/files/write_process.h"
#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::run_store {
namespace {

using test::sample_record;
using test::sample_value;

/// By which nothing is written until the end, unless it is large.
FlushRule never() {
  FlushRule rule;
  rule.records = 1000;
  rule.age = std::chrono::hours(1);
  rule.bytes = std::size_t{1} << 40U;
  return rule;
}

class LargeRecordTest : public ::testing::Test {
 protected:
  std::size_t records_in_file(const std::string& times = "time") const {
    const Hdf5File file = Hdf5File::open_for_reading(path_);
    return read_double_dataset(file, times).size();
  }

  const buckens::test::TemporaryDirectory directory_;
  const std::filesystem::path path_ = directory_ / "results.h5";
  files::WriteProcess writer_;
};

// 30000 nodes: 1.4 MB of displacements.
constexpr int kNodesOfLarge = 30000;

TEST_F(LargeRecordTest, IsInTheFileAtOnce) {
  const results::RecordLayout layout = test::sample_layout(kNodesOfLarge);
  Hdf5Recorder recorder(path_, writer_, layout, test::sample_geometry(), nullptr, "", "", never());
  for (std::size_t k = 0; k < 3; ++k) {
    recorder.write(sample_record(k, layout.num_values()));
    EXPECT_EQ(records_in_file(), k + 1);
  }
  recorder.close();
  const Hdf5File file = Hdf5File::open_for_reading(path_);
  for (std::size_t c = 0; c < layout.channels().size(); ++c) {
    const results::Channel& channel = layout.channel(c);
    const std::vector<double> found = read_any_double_dataset(file, channel.path);
    ASSERT_EQ(found.size(), 3 * channel.size()) << channel.path;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t place = layout.offset(c) + i % channel.size();
      ASSERT_EQ(found[i], sample_value(i / channel.size(), place)) << channel.path << i;
    }
  }
}

TEST_F(LargeRecordTest, ASmallOneWaits) {
  const results::RecordLayout layout = test::sample_layout();
  Hdf5Recorder recorder(path_, writer_, layout, test::sample_geometry(), nullptr, "", "", never());
  recorder.write(sample_record(0, layout.num_values()));
  EXPECT_EQ(records_in_file(), 0U);
  recorder.close();
  EXPECT_EQ(records_in_file(), 1U);
}

/// Every instant of fields is one of the records, which thus cannot wait any longer.
TEST_F(LargeRecordTest, OfFieldsComesAfterTheRecordOfItsInstant) {
  const results::RecordLayout layout = test::sample_layout();
  results::FieldLayout fields;
  fields.fields.add({"fields/bodies/rod/nodes/stress", "Pa", {kNodesOfLarge, 6}, "of nodes", {}});
  Hdf5Recorder recorder(path_, writer_, layout, test::sample_geometry(), &fields, "", "", never());
  for (std::size_t k = 0; k < 2; ++k) {
    recorder.write(sample_record(k, layout.num_values()));
    EXPECT_EQ(records_in_file(), k);
    recorder.write_fields(sample_record(k, fields.fields.num_values()));
    EXPECT_EQ(records_in_file(), k + 1);
    EXPECT_EQ(records_in_file("fields/time"), k + 1);
  }
  recorder.close();
  const Hdf5File file = Hdf5File::open_for_reading(path_);
  const std::vector<double> found = read_any_double_dataset(file, "fields/bodies/rod/nodes/stress");
  ASSERT_EQ(found.size(), 2 * fields.fields.num_values());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t size = fields.fields.num_values();
    // In single precision.
    ASSERT_EQ(found[i], static_cast<double>(static_cast<float>(sample_value(i / size, i % size))));
  }
}

}  // namespace
}  // namespace buckens::run_store
