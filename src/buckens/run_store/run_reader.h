// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/base/name_index.h"
#include "buckens/results/channel.h"
#include "buckens/results/geometry.h"
#include "buckens/results/motion_tables.h"
#include "buckens/run_store/hdf5_file.h"
#include "buckens/run_store/hdf5_undo.h"
#include "buckens/run_store/summary_json.h"
#include "buckens/run_store/table_rows.h"

namespace buckens::run_store {

/// Results as they were at a checkpoint; what was written later may be damaged.
struct AtCheckpoint {
  double last_record = HUGE_VAL;  ///< [s]; negative: none
  double last_fields = HUGE_VAL;  ///< of fields over meshes [s]
  std::shared_ptr<const Undone> undone;
};

/// Reads a run directory: of a finished run, of one in progress in another process, or of one that
/// was killed.
///
/// It sees the records that were complete when it was created. The file may be damaged or made by
/// anybody: anything that does not have the form of a run is refused before use.
class RunReader {
 public:
  /// @throws IoError if the directory contains no run, one without results yet, or a damaged one
  /// @param at what comes after its instants is left out; if the file has no such instants, nothing
  /// is
  explicit RunReader(const std::filesystem::path& directory, const AtCheckpoint& at = {});

  RunStatus status() const { return status_; }
  /// The text of summary.json.
  const std::string& summary_text() const { return summary_text_; }
  const std::string& title() const { return title_; }
  const std::string& version() const { return version_; }
  const results::Geometry& geometry() const { return geometry_; }
  /// The channels as they are stored, in alphabetical order of their paths.
  const results::RecordLayout& layout() const { return layout_; }
  /// A channel by its path, nothing if there is none. Bodies and joints have channels of their own
  /// here, "bodies/rod/pose", also where thousands of them stand in tables.
  std::optional<results::Channel> find(std::string_view path) const;

  /// The channels of sensors in the order of the model file, which is that of the columns of
  /// sensors.csv; in alphabetical order if that file is missing.
  std::vector<const results::Channel*> sensors() const;

  std::size_t num_records() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }  ///< [s], increasing

  /// All values of a channel that find() knows, record after record, each in row-major order.
  /// @throws IoError if there is no such channel or it cannot be read
  std::vector<double> read(std::string_view path) const;
  /// The same for some records, given by their increasing indices.
  std::vector<double> read(std::string_view path, std::span<const std::size_t> records) const;

  /// Fields over meshes, paths "fields/bodies/<body>/nodes/von_mises" and the like; empty if the
  /// run has none.
  const results::RecordLayout& field_layout() const { return field_layout_; }
  const std::vector<double>& field_times() const { return field_times_; }  ///< [s], increasing
  /// The record at the instant of a field record.
  std::size_t record_of_field(std::size_t row) const;
  /// A field at some instants, given by increasing indices into field_times().
  /// @throws IoError if there is no such field or it cannot be read
  std::vector<double> read_fields(std::string_view path, std::span<const std::size_t> rows) const;
  /// Values that exist once: "extremes/bodies/<body>/nodes/von_mises". Empty if they are
  /// missing.
  /// @throws IoError if they cannot be read
  std::vector<double> read_fixed(std::string_view path) const;

 private:
  RunReader() = default;
  void open(const std::filesystem::path& results, const std::shared_ptr<Hdf5Texts>& texts,
            const AtCheckpoint& at);
  void touch_channels() const;
  std::vector<double> read_times(const std::string& path, double last) const;
  std::vector<double> read_rows_of(const results::RecordLayout& layout, std::string_view path,
                                   std::span<const std::size_t> rows) const;
  std::optional<results::TablePart> find_part(std::string_view path) const;
  std::vector<double> read_part(const results::TablePart& part,
                                std::span<const std::size_t> records) const;

  std::filesystem::path directory_;
  std::string summary_text_, title_, version_;
  RunStatus status_ = RunStatus::starting;
  Hdf5File file_;
  results::Geometry geometry_;
  results::RecordLayout layout_, field_layout_;
  std::vector<double> times_, field_times_;
  mutable base::NameIndex bodies_, joints_;  // of those of the geometry
  mutable TableRows table_rows_;
};

}  // namespace buckens::run_store
