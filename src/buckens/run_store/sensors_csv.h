// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/files/output_file.h"
#include "buckens/results/record_sink.h"

namespace buckens::run_store {

/// sensors.csv: the channels `sensors/<name>` as a table for spreadsheets.
///
/// First column "t [s]", then "name [unit]" for scalars and "name.x [unit]" … for vectors (numbers
/// from 1 if the components have no names). Numbers have 17 significant digits, so that they read
/// back as exactly the same doubles. Each line is passed to the system as soon as it is complete.
class SensorsCsv {
 public:
  SensorsCsv() = default;
  /// Creates the file and writes the line of names. @throws IoError
  SensorsCsv(const std::filesystem::path& path, const results::RecordLayout& layout);

  /// @throws IoError
  void write(const results::Record& record);
  /// @throws IoError
  void close() { file_.close(); }

 private:
  files::OutputFile file_;
  std::vector<std::size_t> positions_;  // of the columns in Record::values
  std::string line_;
};

/// Names of the columns that one channel fills, without quotes: "tip.x [m]".
std::vector<std::string> csv_column_names(const results::Channel& channel);

}  // namespace buckens::run_store
