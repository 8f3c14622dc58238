// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "buckens/io/run_reader.h"

namespace buckens::io {

/// Reads the records that a page shows, channel by channel, in the page's form.
class FrameReader {
 public:
  /// @param frames indices of the records, increasing
  FrameReader(const RunReader& run, std::vector<std::size_t> frames);

  std::size_t num_frames() const { return frames_.size(); }
  /// Base64 of the times.
  std::string times() const;
  /// Base64 of a whole channel.
  std::string values(const std::string& path) const;
  /// Base64 of a channel's values per frame at the given places only.
  std::string values_at(const std::string& path, const std::vector<std::size_t>& places) const;
  /// Numbers of a whole channel.
  std::vector<double> numbers(const std::string& path) const;
  /// Values of a scalar channel, empty where it is missing.
  std::vector<double> scalars(const std::string& path) const;
  /// Number of values of a channel, 0 where it is missing.
  std::size_t size_of(const std::string& path) const;

 private:
  const RunReader& run_;
  std::vector<std::size_t> frames_;
};

}  // namespace buckens::io
