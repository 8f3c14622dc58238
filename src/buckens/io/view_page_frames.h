// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "buckens/io/run_reader.h"

namespace buckens::io {

/// Reads the records that a page shows, channel by channel, in the page's form.
class FrameReader {
 public:
  /// @param frames indices of the records, increasing
  /// @param coded  whether rows are rounded to 16 bits
  FrameReader(const RunReader& run, std::vector<std::size_t> frames, bool coded);

  std::size_t num_frames() const { return frames_.size(); }
  bool coded() const { return coded_; }
  const RunReader& run() const { return run_; }
  /// Base64 of the times.
  std::string times() const;
  /// Base64 of a whole channel as float32.
  std::string values(const std::string& path) const;
  /// A channel's rows, one per frame: `choose` makes the page's row of the channel's.
  using Choose = std::function<std::vector<double>(const std::vector<double>&)>;
  nlohmann::ordered_json rows(const std::string& path, const Choose& choose) const;
  /// Values of a scalar channel, empty where it is missing.
  std::vector<double> scalars(const std::string& path) const;
  /// Number of values of a channel, 0 where it is missing.
  std::size_t size_of(const std::string& path) const;

 private:
  const RunReader& run_;
  std::vector<std::size_t> frames_;
  bool coded_;
};

/// The values at some places.
std::vector<double> values_at(const std::vector<double>& all, const std::vector<std::size_t>& at);

}  // namespace buckens::io
