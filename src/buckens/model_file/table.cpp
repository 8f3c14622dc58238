// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/table.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/member_types.h"
#include "buckens/base/units.h"
#include "buckens/files/text_file.h"
#include "buckens/model_file/fields.h"

namespace buckens::model_file {

namespace {

std::vector<std::string> split_row(const std::string& text) {
  const bool has_commas = text.find(',') != std::string::npos;
  const bool has_semicolons = text.find(';') != std::string::npos;
  const std::string separators = has_semicolons ? ";" : has_commas ? "," : " \t";
  std::vector<std::string> cells;
  std::size_t begin = 0;
  const bool skips_empty = !has_semicolons && !has_commas;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    std::string cell = text.substr(begin, end - begin);
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
    if (!skips_empty || !cell.empty()) cells.push_back(cell);
    begin = end + 1;
  }
  return cells;
}

/// The text as far as it can be shown.
std::string shown_cell(const std::string& cell) {
  constexpr std::size_t kMostShown = 40;
  std::string out = cell.substr(0, kMostShown);
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c > 0x7E; }, '?');
  return cell.size() > kMostShown ? out + "..." : out;
}

/// Number in a column, counted from 1.
double cell_value(const std::vector<std::string>& cells, int column, const SourceLocation& row) {
  const std::string& cell = cells[static_cast<std::size_t>(column - 1)];
  const auto value = base::parse_number(cell);
  if (value) return *value;
  SourceLocation where = row;
  for (int k = 0; k + 1 < column; ++k) {
    where.column += static_cast<int>(cells[static_cast<std::size_t>(k)].size()) + 1;
  }
  throw InputError(where,
                   fmt::format("\"{}\" is not a number; write decimals such as 1.5e-3, with a "
                               "point, and separate columns with commas, semicolons or spaces",
                               shown_cell(cell)));
}

/// Whether a cell is meant as a number, even one that cannot be read.
bool begins_like_number(const std::string& cell) {
  const std::size_t first = cell.find_first_not_of(" \t+-.");
  return first != std::string::npos && cell[first] >= '0' && cell[first] <= '9';
}

/// The map with the name of a file under `file`, where it may stand under `table`, too.
YamlNode with_file_key(YamlNode node) {
  for (YamlEntry& entry : node.entries) {
    if (entry.key == "table" && entry.value.is_scalar() && node.find("file") == nullptr) {
      entry.key = "file";
    }
  }
  return node;
}

}  // namespace

model::Found problem(const TableLawSpec& spec) {
  if (spec.table.empty() == spec.file.empty()) {
    return model::Finding{
        "",
        "exactly one of the keys table and file is needed, and a table has at least one "
        "point [time in s, value]"};
  }
  if (spec.file.empty() && spec.column) {
    return model::Finding{
        "column",
        "this key applies to files only, since a table has one column of values; remove it"};
  }
  return std::nullopt;
}

CsvColumns read_csv_columns(const std::filesystem::path& path, int column) {
  std::istringstream stream(files::read_text_file(path, "table"));
  CsvColumns out;
  std::string line;
  bool may_be_heading = true;
  for (int number = 1; std::getline(stream, line); ++number) {
    const SourceLocation where{path.string(), number, 1};
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const std::vector<std::string> cells = split_row(line);
    const bool is_heading = may_be_heading && !begins_like_number(cells[0]);
    may_be_heading = false;
    if (is_heading) continue;
    if (static_cast<int>(cells.size()) < column) {
      throw InputError(
          where,
          fmt::format("the row has {} column{}, but the values are expected in column {}; separate "
                      "columns with commas, semicolons or spaces, or give another `column`",
                      cells.size(), cells.size() == 1 ? "" : "s", column));
    }
    out.times.push_back(cell_value(cells, 1, where));
    out.values.push_back(cell_value(cells, column, where));
  }
  if (out.times.empty())
    throw InputError({path.string(), 0, 0},
                     "the table has no rows; write a time in seconds and a value in each");
  return out;
}

base::TimeLaw read_table_law(const ReadPlace& given, const base::FieldNote& note,
                             const ReadContext& context) {
  const YamlNode node = with_file_key(given.node);
  const ReadPlace place{node, given.path};
  TableLawSpec spec;
  ReadContext own = context;
  read_record(place, own, base::member_of(spec));
  CsvColumns columns;
  if (spec.file.empty()) {
    for (const auto& [time, value] : spec.table) {
      columns.times.push_back(time);
      columns.values.push_back(value);
    }
  } else {
    try {
      columns = read_csv_columns(context.directory / spec.file, spec.column.value_or(2));
    } catch (const IoError& error) {
      throw IoError(place.node.find("file")->where,
                    fmt::format("{}: {}", place.path, error.what()));
    }
  }
  if (!spec.unit.empty()) {
    const auto unit = base::parse_unit(spec.unit);
    const ReadPlace unit_place{*place.node.find("unit"), place.path + ".unit"};
    if (!unit || !base::accepts(note.dimension, unit->dimension)) {
      fail(unit_place,
           fmt::format("\"{}\" is not a unit of {}, such as {}", spec.unit,
                       base::dimension_name(note.dimension), base::si_unit(note.dimension)));
    }
    for (double& value : columns.values) value *= unit->factor;
  }
  try {
    return base::TimeLaw::table(std::move(columns.times), std::move(columns.values),
                                spec.interpolation, spec.extrapolation, place.node.where);
  } catch (const InputError& error) {
    fail(place, error.what());
  }
}

}  // namespace buckens::model_file
