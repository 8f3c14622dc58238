// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_comparison.h"

#include <gtest/gtest.h>

#include "buckens/base/test/temporary_directory.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::run_store {
namespace {

/// A run of ten records; `changed` of them have other values.
void write_sample(const std::filesystem::path& path, std::size_t changed) {
  RunDirectory run(path);
  const results::RecordLayout layout = test::sample_layout();
  run.begin(layout, test::sample_geometry());
  for (std::size_t i = 0; i < 10; ++i) {
    results::Record record = test::sample_record(i, layout.num_values());
    for (double& value : record.values) value += i < changed ? 0.25 * static_cast<double>(i) : 0.0;
    run.write(record);
  }
  run.finish(test::finished_summary());
}

TEST(RunComparison, PiecesOfAChannelAddUp) {
  const buckens::test::TemporaryDirectory directory;
  write_sample(directory / "a", 0);
  write_sample(directory / "b", 7);
  const RunReader a(directory / "a"), b(directory / "b");
  const RunComparison whole = compare_runs(a, b);
  ASSERT_FALSE(whole.quantities.empty());
  EXPECT_EQ(whole.common_times, 10U);
  // One record at a time, and pieces that do not divide ten.
  for (const std::size_t numbers : {std::size_t{1}, std::size_t{4}, std::size_t{100}}) {
    const RunComparison found = compare_runs(a, b, numbers);
    ASSERT_EQ(found.quantities.size(), whole.quantities.size());
    for (std::size_t k = 0; k < whole.quantities.size(); ++k) {
      const QuantityDifference &x = found.quantities[k], &y = whole.quantities[k];
      EXPECT_EQ(x.quantity, y.quantity);
      EXPECT_EQ(x.largest, y.largest) << y.quantity;
      EXPECT_EQ(x.difference, y.difference) << y.quantity;
      EXPECT_EQ(x.at, y.at) << y.quantity;
      EXPECT_EQ(x.relative, y.relative) << y.quantity;
    }
  }
  const int angle = a.layout().find("sensors/angle");
  ASSERT_GE(angle, 0);
  for (const QuantityDifference& q : whole.quantities) {
    if (q.quantity != "sensors/angle") continue;
    EXPECT_NEAR(q.difference, 1.5, 1e-12);  // rounding of values of the order of one
    EXPECT_EQ(q.at, a.times()[6]);
  }
}

/// A run of eight records with one sensor, which is `value` in the fifth and else zero.
void write_pose_sensor(const std::filesystem::path& path, double value) {
  RunDirectory run(path);
  results::RecordLayout layout;
  layout.add({"sensors/pose", "m", {}, "called as what bodies have", {}});
  run.begin(layout, test::sample_geometry());
  for (int i = 0; i < 8; ++i) run.write({1e-3 * i, {i == 4 ? value : 0.0}});
  run.finish(test::finished_summary());
}

TEST(RunComparison, OnlyPosesOfBodiesHaveQuaternions) {
  const buckens::test::TemporaryDirectory directory;
  write_pose_sensor(directory / "a", 9);
  write_pose_sensor(directory / "b", -9);
  const RunComparison found = compare_runs(RunReader(directory / "a"), RunReader(directory / "b"));
  ASSERT_EQ(found.quantities.size(), 1U);
  EXPECT_EQ(found.quantities[0].difference, 18.0);
}

}  // namespace
}  // namespace buckens::run_store
