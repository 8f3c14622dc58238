// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace buckens::page {

/// Rows of numbers in the page (PageRows in viewer/src/page_data.ts): float32, or codes of 16 bits
/// over the range of each row, with errors of at most 1/131068 of that range.
class PageRowsWriter {
 public:
  explicit PageRowsWriter(bool coded) : coded_(coded) {}

  /// Numbers that are not finite count as missing.
  void add(std::span<const double> row);
  nlohmann::ordered_json json() const;

 private:
  bool coded_;
  std::vector<double> plain_;
  std::vector<std::uint16_t> codes_;
  std::vector<double> ranges_;
};

}  // namespace buckens::page
