// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/stored_size.h"

#include <gtest/gtest.h>

namespace buckens::results {
namespace {

RecordLayout layout_of(std::vector<int> shape) {
  RecordLayout layout;
  layout.add({.path = "sensors/a",
              .unit = "m",
              .shape = std::move(shape),
              .description = {},
              .components = {}});
  return layout;
}

TEST(StoredSize, RowsOfAChunk) {
  EXPECT_EQ(chunk_rows(1), 256U);  // not 64 KiB of a scalar
  EXPECT_EQ(chunk_rows(100), 81U);
  EXPECT_EQ(chunk_rows(100000), 1U);
}

TEST(StoredSize, StartedChunksCountInFull) {
  const RecordLayout scalar = layout_of({});
  const double one = stored_bytes(scalar, 1, sizeof(double));
  EXPECT_EQ(one, stored_bytes(scalar, 256, sizeof(double)));
  // The instants and the scalar.
  EXPECT_EQ(stored_bytes(scalar, 257, sizeof(double)) - one, 2 * 256 * 8.0);
  // Large channels have chunks of one row, without unused space.
  const RecordLayout large = layout_of({10000, 3});
  const double ten = stored_bytes(large, 10, sizeof(float));
  EXPECT_EQ(stored_bytes(large, 11, sizeof(float)) - ten, 30000 * 4.0);
}

TEST(StoredSize, NothingRecordedTakesNothing) {
  EXPECT_EQ(stored_bytes(RecordLayout(), 100, sizeof(float)), 0.0);
  EXPECT_EQ(stored_bytes(Geometry()), 0.0);
}

}  // namespace
}  // namespace buckens::results
