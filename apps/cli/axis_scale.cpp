// SPDX-License-Identifier: Apache-2.0
#include "cli/axis_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace buckens::cli {

namespace {

/// Units that take prefixes.
constexpr std::array kScalable = {"m", "s", "N", "Pa", "J", "W", "Hz", "N m", "m/s", "m/s^2"};

struct Prefix {
  int exponent;
  const char* text;
};
constexpr std::array kPrefixes = {Prefix{-12, "p"}, Prefix{-9, "n"}, Prefix{-6, "\u00b5"},
                                  Prefix{-3, "m"},  Prefix{0, ""},   Prefix{3, "k"},
                                  Prefix{6, "M"},   Prefix{9, "G"}};

/// 1, 2 or 5 times a power of ten, not less than `step`.
double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= step * (1.0 - 1e-9)) return digit * power;
  }
  return 10.0 * power;
}

void choose_unit(double largest, const std::string& unit, AxisScale& out) {
  out.unit = unit == "1" ? "" : unit;
  if (std::find(kScalable.begin(), kScalable.end(), unit) == kScalable.end()) return;
  for (const Prefix& prefix : kPrefixes) {
    if (largest >= 0.9999 * std::pow(10.0, prefix.exponent) || &prefix == kPrefixes.begin()) {
      out.factor = std::pow(10.0, -prefix.exponent);
      out.unit = prefix.text + unit;
    }
  }
}

}  // namespace

AxisScale make_scale(double least, double most, const std::string& unit, bool is_tight,
                     int most_ticks) {
  AxisScale out;
  const double largest = std::max(std::abs(least), std::abs(most));
  if (!(most - least > 1e-12 * largest)) {  // a constant gets some room
    const double room = largest > 0.0 ? 0.1 * largest : 1.0;
    least -= room;
    most += room;
  }
  choose_unit(std::max(std::abs(least), std::abs(most)), unit, out);
  const double step = round_step((most - least) * out.factor / most_ticks) / out.factor;
  const double first = std::ceil(least / step - 1e-9);
  const double last = std::floor(most / step + 1e-9);
  out.from = is_tight ? least : step * std::floor(least / step + 1e-9);
  out.to = is_tight ? most : step * std::ceil(most / step - 1e-9);
  const double begin = is_tight ? first : std::round(out.from / step);
  const double end = is_tight ? last : std::round(out.to / step);
  const double written = step * out.factor;
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(written) - 1e-9)), 0, 12);
  const bool is_plain = largest * out.factor < 1e6 && written > 1e-6;
  for (double k = begin; k <= end; k += 1.0) {
    const double value = k == 0.0 ? 0.0 : k * step;
    out.ticks.push_back(value);
    out.labels.push_back(is_plain ? fmt::format("{:.{}f}", value * out.factor, decimals)
                                  : fmt::format("{:.4g}", value * out.factor));
  }
  return out;
}

}  // namespace buckens::cli
