// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "buckens/base/units.h"

namespace buckens::cli {

/// Of an option `--threads`.
inline constexpr int kMostThreads = 256;

/// Accepts plain numbers from `least` to `most`. The ranges of CLI11 accept "nan" and print limits
/// with six decimals.
inline CLI::Validator number_between(double least, double most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    const auto value = base::parse_number(text);
    if (value && *value >= least && *value <= most) return {};
    return fmt::format("{} is not a number from {:.10g} to {:.10g}", text, least, most);
  };
  return {check, fmt::format("{:.10g} to {:.10g}", least, most)};
}

/// Accepts numbers, or positive ones only; neither infinities nor NaN.
inline CLI::Validator any_number(bool is_positive) {
  const auto check = [is_positive](const std::string& text) -> std::string {
    const auto value = base::parse_number(text);
    if (value && (!is_positive || *value > 0)) return {};
    return fmt::format("{} is not a {}number", text, is_positive ? "positive " : "");
  };
  return {check, is_positive ? "positive" : ""};
}

}  // namespace buckens::cli
