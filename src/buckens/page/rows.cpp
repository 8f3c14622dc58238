// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/rows.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "buckens/files/base64.h"

namespace buckens::page {

namespace {

constexpr double kSteps = 65534;
constexpr std::uint16_t kMissing = 65535;

}  // namespace

void PageRowsWriter::add(std::span<const double> row) {
  if (!coded_) {
    plain_.insert(plain_.end(), row.begin(), row.end());
    return;
  }
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const double value : row) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 0;
  // The page counts from the rounded ends.
  low = static_cast<float>(low);
  high = static_cast<float>(high);
  ranges_.insert(ranges_.end(), {low, high});
  const double steps = high > low ? kSteps / (high - low) : 0.0;
  for (const double value : row) {
    const double code = std::clamp(std::round((value - low) * steps), 0.0, kSteps);
    codes_.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(code) : kMissing);
  }
}

nlohmann::ordered_json PageRowsWriter::json() const {
  if (!coded_) return {{"type", "f32"}, {"values", files::base64_float32(plain_)}};
  return {{"type", "u16"},
          {"values", files::base64_uint16(codes_)},
          {"ranges", files::base64_float32(ranges_)}};
}

}  // namespace buckens::page
