// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/time_law.h"
#include "buckens/model/check/finding.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// A law of time given by points, as in the model file. Exactly one of table and file is given; a
/// text instead of the points is the name of the file.
struct TableLawSpec {
  std::vector<std::array<double, 2>> table;
  std::string file;
  std::optional<int> column;  ///< of a file, counted from 1; 2 unless given
  std::string unit;
  base::Interpolation interpolation = base::Interpolation::linear;
  base::Extrapolation extrapolation = base::Extrapolation::refuse;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("table", table, "points [time in s, value], or the name of a CSV `file`")
              .like("[[0, 0], [0.1, 2], [0.5, 2]]")
              .otherwise("give this or `file`"));
    visit(base::field("file", file,
                      "CSV file with the time in s in its first column; relative to the model file")
              .like("torque.csv")
              .otherwise("give this or `table`"));
    visit(base::field("column", column, "of a file: column of the values, counted from 1")
              .positive()
              .otherwise("2"));
    visit(base::field("unit", unit, "unit of the values").like("N m").otherwise("SI"));
    visit(base::field("interpolation", interpolation, "between the points"));
    visit(base::field("extrapolation", extrapolation,
                      "outside the table: an error, or the first and last value"));
  }
};

/// What is wrong with a table as written.
model::Found problem(const TableLawSpec& spec);

/// Reads a law given by `table` or `file`.
base::TimeLaw read_table_law(const ReadPlace& place, const base::FieldNote& note,
                             const ReadContext& context);

/// Time and one more column of a text file with numbers separated by commas, semicolons, blanks or
/// tabs. Lines that begin with # and one heading line, whose first cell does not begin like a
/// number, are skipped. Numbers may be in double quotes.
/// @throws IoError if the file cannot be read, InputError with file and line for its contents
struct CsvColumns {
  std::vector<double> times, values;
};
CsvColumns read_csv_columns(const std::filesystem::path& path, int column);

}  // namespace buckens::model_file
