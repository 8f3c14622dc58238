// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/time_law.h"
#include "buckens/io/model_file_values.h"

namespace buckens::io {

/// A law of time by points, as the model file writes it. Exactly one of table and file is given.
struct TableLawSpec {
  std::vector<std::array<double, 2>> table;
  std::string file;
  int column = 2;
  std::string unit;
  base::Interpolation interpolation = base::Interpolation::linear;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("table", table, "points [time in s, value]")
              .like("[[0, 0], [0.1, 2], [0.5, 2]]")
              .otherwise("give this or `file`"));
    visit(base::field("file", file,
                      "CSV file with the time in s in its first column; relative to the model file")
              .like("torque.csv")
              .otherwise("give this or `table`"));
    visit(base::field("column", column, "column of the values, counted from 1").positive());
    visit(base::field("unit", unit, "unit of the values").like("N m").otherwise("SI"));
    visit(base::field("interpolation", interpolation,
                      "between the points; outside of their range the first and last value hold"));
  }
};

/// Reads a law given by `table` or `file`.
base::TimeLaw read_table_law(const ReadPlace& place, const base::FieldNote& note,
                             const ReadContext& context);

/// Time and one more column of a text file with numbers separated by commas, semicolons, blanks or
/// tabs. Lines that begin with # and one heading line are skipped.
/// @throws IoError if the file cannot be read, InputError with file and line for its content
struct CsvColumns {
  std::vector<double> times, values;
};
CsvColumns read_csv_columns(const std::filesystem::path& path, int column);

}  // namespace buckens::io
