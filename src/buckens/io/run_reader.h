// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/io/hdf5_file.h"
#include "buckens/io/summary_json.h"
#include "buckens/results/channel.h"
#include "buckens/results/geometry.h"

namespace buckens::io {

/// Reads a run directory: of a finished run, of one that goes on in another process, or of one that
/// was killed.
///
/// It sees the records that were complete when it was made.
class RunReader {
 public:
  /// @throws IoError if the directory holds no run, or one without any results yet
  explicit RunReader(const std::filesystem::path& directory);

  RunStatus status() const { return status_; }
  /// The text of summary.json.
  const std::string& summary_text() const { return summary_text_; }
  const std::string& title() const { return title_; }
  const std::string& version() const { return version_; }
  const results::Geometry& geometry() const { return geometry_; }
  /// The channels, in alphabetical order of their paths.
  const results::RecordLayout& layout() const { return layout_; }

  std::size_t num_records() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }  ///< [s], increasing

  /// All values of a channel, record after record, each in row-major order.
  /// @throws IoError if there is no such channel or it cannot be read
  std::vector<double> read(std::string_view path) const;
  /// The same for some records, given by their increasing indices.
  std::vector<double> read(std::string_view path, std::span<const std::size_t> records) const;

 private:
  void read_channels(const std::string& group);
  void read_times();

  std::string summary_text_, title_, version_;
  RunStatus status_ = RunStatus::starting;
  Hdf5File file_;
  results::Geometry geometry_;
  results::RecordLayout layout_;
  std::vector<double> times_;
};

}  // namespace buckens::io
