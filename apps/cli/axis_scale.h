// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace buckens::cli {

/// An axis of a diagram: its range, round ticks and the unit in which they are written.
struct AxisScale {
  double from = 0, to = 1;    ///< in the unit of the data
  double factor = 1;          ///< of the written numbers: written = value × factor
  std::string unit;           ///< of the written numbers: "mm"
  std::vector<double> ticks;  ///< in the unit of the data, within the range
  std::vector<std::string> labels;
};

/// Chooses range, ticks and prefix for values between two numbers.
/// @param is_tight the range is that of the values; else it reaches to the next ticks
/// @param most_ticks at least 2
AxisScale make_scale(double least, double most, const std::string& unit, bool is_tight,
                     int most_ticks);

}  // namespace buckens::cli
