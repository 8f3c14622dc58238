// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/range.h"

#include <cmath>

#include <fmt/format.h>

namespace buckens::model {

namespace {

// No quantity in SI units is larger, and its fourth powers, such as second moments of area, are
// still finite.
constexpr double kLargestNumber = 1e60;

}  // namespace

std::optional<std::string> broken_rule(const base::FieldNote& note, double value) {
  if (!std::isfinite(value)) return "be a finite number";
  if (std::abs(value) > kLargestNumber) {
    return fmt::format("not exceed {:g} in SI units, or calculations overflow", kLargestNumber);
  }
  switch (note.range) {
    case base::Range::any:
      break;
    case base::Range::positive:
      if (!(value > 0)) return "be positive";
      break;
    case base::Range::non_negative:
      if (!(value >= 0)) return "not be negative";
      break;
    case base::Range::fraction:
      if (!(value >= 0 && value <= 1)) return "lie between 0 and 1";
      break;
    case base::Range::poisson:
      if (!(value > -1 && value <= 0.5)) return "lie between -1 and 0.5";
      break;
  }
  return std::nullopt;
}

std::string refusal(const std::string& shown_value, const std::string& rule) {
  return fmt::format("{} is not allowed: the value must {}", shown_value, rule);
}

}  // namespace buckens::model
