// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/table_rows.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::run_store {
namespace {

constexpr std::size_t kRows = 100;
constexpr std::size_t kWidth = 3;

/// A table whose values say where they come from, and how often it was read.
struct Source {
  std::size_t reads = 0;
  std::size_t most = 0;  // values at once

  TableRows::Read read() {
    return [this](const std::string& table, std::span<const std::size_t> records, std::size_t first,
                  std::size_t count) {
      ++reads;
      std::vector<double> out;
      for (const std::size_t record : records) {
        for (std::size_t row = first; row < first + count; ++row) {
          for (std::size_t k = 0; k < kWidth; ++k) out.push_back(value(table, record, row, k));
        }
      }
      most = std::max(most, out.size());
      return out;
    };
  }

  static double value(const std::string& table, std::size_t record, std::size_t row,
                      std::size_t k) {
    return static_cast<double>(1000000 * record + 10 * row + k) + (table == "b" ? 0.5 : 0.0);
  }
};

RowWish wish(const std::string& table, std::size_t row, std::size_t first, std::size_t count) {
  return {table, kRows, kWidth, row, first, count};
}

TEST(TableRows, GivesValuesRecordAfterRecord) {
  Source source;
  TableRows rows;
  const std::vector<std::size_t> records = {2, 3, 7};
  const std::vector<double> found = rows.get(wish("a", 42, 1, 2), records, source.read());
  ASSERT_EQ(found.size(), 6U);
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_EQ(found[2 * r], Source::value("a", records[r], 42, 1));
    EXPECT_EQ(found[2 * r + 1], Source::value("a", records[r], 42, 2));
  }
}

TEST(TableRows, ReadsManyRowsAtOnce) {
  Source source;
  TableRows rows;
  const std::vector<std::size_t> all = {0, 1, 2}, one = {1};
  // As an animation with a still picture asks: every body in all records and in one.
  for (std::size_t row = 0; row < kRows; ++row) {
    for (const std::string table : {"a", "b"}) {
      EXPECT_EQ(rows.get(wish(table, row, 0, 1), all, source.read())[1],
                Source::value(table, 1, row, 0));
      EXPECT_EQ(rows.get(wish(table, row, 0, 1), one, source.read())[0],
                Source::value(table, 1, row, 0));
    }
  }
  EXPECT_EQ(source.reads, 4U);
}

TEST(TableRows, KeepsNoMoreThanItMay) {
  Source source;
  constexpr std::size_t kMost = 90;  // ten rows of three records
  TableRows rows(kMost);
  const std::vector<std::size_t> records = {0, 1, 2};
  for (std::size_t row = 0; row < kRows; ++row) {
    EXPECT_EQ(rows.get(wish("a", row, 2, 1), records, source.read())[2],
              Source::value("a", 2, row, 2));
  }
  EXPECT_EQ(source.reads, kRows / 10);
  EXPECT_LE(source.most, kMost);
}

}  // namespace
}  // namespace buckens::run_store
