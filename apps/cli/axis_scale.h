// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace buckens::cli {

/// An axis of a diagram: its range, round ticks and the unit of the labels.
struct AxisScale {
  double from = 0, to = 1;    ///< in the unit of the data
  double factor = 1;          ///< of the labels: label = value × factor
  std::string unit;           ///< of the labels: "mm"
  std::vector<double> ticks;  ///< in the unit of the data, within the range
  std::vector<std::string> labels;
};

/// Chooses range, ticks and prefix for values between two numbers.
/// @param is_tight the range is that of the values; else it extends to the next ticks
/// @param most_ticks at least 2
AxisScale make_scale(double least, double most, const std::string& unit, bool is_tight,
                     int most_ticks);

}  // namespace buckens::cli
