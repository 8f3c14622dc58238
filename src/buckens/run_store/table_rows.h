// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace buckens::run_store {

/// What is wanted of a table: values of one of its rows, in some records.
struct RowWish {
  std::string table;      ///< path of the channel
  std::size_t rows = 0;   ///< of the table
  std::size_t width = 0;  ///< values of a row
  std::size_t row = 0;    ///< the wanted one
  std::size_t first = 0;  ///< of the values in it
  std::size_t count = 0;  ///< of them
};

/// Rows of tables with thousands of them, one after the other without reading the file for each.
///
/// Whoever asks for one row will ask for the next in the same records: many rows are read at once
/// and kept for later calls. What is kept takes at most some 130 MB, whatever the table.
class TableRows {
 public:
  /// Reads rows `first` to `first + count` of a table in some records, record after record.
  using Read = std::function<std::vector<double>(const std::string& table,
                                                 std::span<const std::size_t> records,
                                                 std::size_t first, std::size_t count)>;

  explicit TableRows(std::size_t most_values = 4U << 20U) : most_values_(most_values) {}

  /// The wanted values, record after record.
  std::vector<double> get(const RowWish& wish, std::span<const std::size_t> records,
                          const Read& read);

 private:
  struct Block {
    std::string table;
    std::vector<std::size_t> records;
    std::size_t first = 0, count = 0;  // rows
    std::vector<double> values;
  };

  const Block* find(const RowWish& wish, std::span<const std::size_t> records) const;
  const Block& add(const RowWish& wish, std::span<const std::size_t> records, const Read& read);

  std::size_t most_values_;  // of a block
  std::vector<Block> blocks_;
  std::size_t oldest_ = 0;
};

}  // namespace buckens::run_store
