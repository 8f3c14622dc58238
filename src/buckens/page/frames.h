// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "buckens/run_store/run_reader.h"

namespace buckens::page {

/// The instants that a page shows.
struct PageFrames {
  std::vector<std::size_t> records;     ///< of the run, increasing
  std::vector<std::size_t> field_rows;  ///< of the fields over meshes, increasing
  std::vector<int> field_frames;        ///< index into `records` of each of them
};

/// At most about `limit` frames, evenly spread, the first and the last among them. If a run has
/// fields over meshes, they are at the fields' instants, unless those are very few: then there are
/// frames without fields between them.
PageFrames choose_frames(const run_store::RunReader& run, bool with_fields, std::size_t limit);

/// Reads the records that a page shows, channel by channel, in the page's form.
class FrameReader {
 public:
  /// @param coded whether rows are rounded to 16 bits
  FrameReader(const run_store::RunReader& run, PageFrames frames, bool coded);

  const PageFrames& frames() const { return frames_; }
  std::size_t num_frames() const { return frames_.records.size(); }
  /// Base64 of the times.
  std::string times() const;
  /// Base64 of a whole channel as float32.
  std::string values(const std::string& path) const;
  /// A channel's rows, one per frame: `choose` converts the channel's row to the page's.
  using Choose = std::function<std::vector<double>(const std::vector<double>&)>;
  nlohmann::ordered_json rows(const std::string& path, const Choose& choose) const;
  /// The same for a field over a mesh, one row per instant of the fields.
  nlohmann::ordered_json field_rows(const std::string& path, const Choose& choose) const;
  /// The same for values that exist once: one row.
  nlohmann::ordered_json fixed_row(const std::string& path, const Choose& choose) const;
  /// Values of a scalar channel, empty if it is missing.
  std::vector<double> scalars(const std::string& path) const;
  /// Number of values of a channel, 0 if it is missing.
  std::size_t size_of(const std::string& path) const;

 private:
  const run_store::RunReader& run_;
  PageFrames frames_;
  bool coded_;
};

/// The values at given places.
std::vector<double> values_at(const std::vector<double>& all, const std::vector<std::size_t>& at);

}  // namespace buckens::page
