// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/summary_table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/csv_row.h"
#include "buckens/files/write_process.h"
#include "buckens/run_store/hdf5_file.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::sweep {

namespace {

std::optional<double> number_in(const std::string& text) {
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "tip.vx [m/s] last" as the name of a data set, "tip.vx last", and its unit, "m/s".
std::pair<std::string, std::string> name_and_unit(const std::string& column) {
  std::string name = column, unit = "1";
  const std::size_t open = column.rfind(" ["), close = column.rfind(']');
  if (open != std::string::npos && close != std::string::npos && open < close) {
    unit = column.substr(open + 2, close - open - 2);
    name = column.substr(0, open) + column.substr(close + 1);
  }
  std::replace(name.begin(), name.end(), '/', '_');
  return {name.empty() || name == "." ? "_" : name, unit};
}

}  // namespace

void SummaryTable::add(const std::string& column, const std::string& cell) {
  if (std::find(columns_.begin(), columns_.end(), column) == columns_.end()) {
    columns_.push_back(column);
  }
  rows_.back()[column] = cell;
}

void SummaryTable::add_row(const SummaryCells& cells) {
  begin_row();
  for (const auto& [column, cell] : cells) add(column, cell);
}

std::string SummaryTable::cell(std::size_t row, const std::string& column) const {
  const auto found = rows_.at(row).find(column);
  return found == rows_[row].end() ? std::string() : found->second;
}

SummaryCells SummaryTable::cells(std::size_t row) const {
  SummaryCells out;
  for (const std::string& column : columns_) {
    const auto found = rows_.at(row).find(column);
    if (found != rows_[row].end()) out.emplace_back(column, found->second);
  }
  return out;
}

std::string SummaryTable::csv() const {
  std::string out;
  for (const std::string& column : columns_) {
    out += (out.empty() ? "" : ",") + files::csv_cell(column);
  }
  for (const auto& row : rows_) {
    out += '\n';
    bool is_first = true;
    for (const std::string& column : columns_) {
      if (!is_first) out += ',';
      is_first = false;
      const auto cell = row.find(column);
      if (cell != row.end()) out += files::csv_cell(cell->second);
    }
  }
  return out + '\n';
}

void SummaryTable::write_hdf5(const std::filesystem::path& file) const {
  std::filesystem::path part = file;
  part += ".part";
  files::WriteProcess writer;
  run_store::Hdf5File out = run_store::Hdf5File::create(part, writer);
  std::set<std::string> names;
  for (std::size_t k = 0; num_rows() > 0 && k < columns_.size(); ++k) {
    auto [name, unit] = name_and_unit(columns_[k]);
    while (!names.insert(name).second) name += "_";
    std::vector<std::string> texts;
    std::vector<double> numbers;
    for (std::size_t row = 0; row < num_rows(); ++row) {
      texts.push_back(cell(row, columns_[k]));
      if (const auto value = number_in(texts.back())) numbers.push_back(*value);
    }
    // Names and reasons are texts, whatever they look like.
    const bool is_text = columns_[k] == "name" || columns_[k] == "message";
    const std::string path = "/" + name;
    if (!is_text && numbers.size() == texts.size()) {
      run_store::write_dataset(out, path, {numbers.size()}, std::span<const double>(numbers));
      run_store::write_attribute(out, path, "unit", unit);
    } else {
      run_store::write_dataset(out, path, texts);
    }
    run_store::write_attribute(out, path, "column", columns_[k]);
    run_store::write_attribute(out, path, "position", static_cast<int>(k));
  }
  out.close();
  std::error_code error;
  std::filesystem::rename(part, file, error);
  if (error) {
    throw IoError(fmt::format("{}: cannot write the table: {}.", file.string(), error.message()));
  }
}

}  // namespace buckens::sweep
