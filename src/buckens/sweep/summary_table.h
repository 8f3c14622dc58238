// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace buckens::sweep {

/// Cells of one variant with the names of their columns, in the order of the columns.
using SummaryCells = std::vector<std::pair<std::string, std::string>>;

/// The table of a sweep: a row per variant, cells as text. Columns keep the order of their first
/// use; unknown cells are empty.
class SummaryTable {
 public:
  void begin_row() { rows_.emplace_back(); }
  void add(const std::string& column, const std::string& cell);
  void add_row(const SummaryCells& cells);

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t num_rows() const { return rows_.size(); }
  /// Empty where the row has none.
  std::string cell(std::size_t row, const std::string& column) const;
  SummaryCells cells(std::size_t row) const;

  /// As RFC 4180 has it.
  std::string csv() const;
  /// Writes the table as HDF5, a data set per column: numbers where all cells are numbers (missing
  /// ones NaN), texts otherwise. The name of the column is the attribute `column`, its unit `unit`.
  /// Readers see the old file or the new one. @throws IoError
  void write_hdf5(const std::filesystem::path& file) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::map<std::string, std::string>> rows_;
};

}  // namespace buckens::sweep
