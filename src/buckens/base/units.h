// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/base/dimension.h"

namespace buckens::base {

/// A unit of measurement: its size in SI units and its dimension.
struct Unit {
  double factor = 1;
  Dimension dimension;
};

/// Reads a unit or a product of units: "mm", "kg m^2", "N*s/m", "m/s^2", "1/s", "N m/rad", "%".
/// A slash divides by the one unit that follows it; more divisions need more slashes, and a product
/// after a slash is refused as ambiguous.
/// @return empty if it is not a unit
std::optional<Unit> parse_unit(std::string_view text);

/// Names of all simple units.
const std::vector<std::string>& unit_names();

/// A quantity as written: a formula or number, optionally followed by white space and a unit.
struct QuantityText {
  std::string formula;
  std::string unit;  ///< empty: SI
};

/// Splits "10*sin(t) N m" into formula and unit. The unit is the longest ending after white space
/// that reads as a unit and does not follow an operator. A unit may also follow a plain number
/// directly: "75mm".
QuantityText split_quantity(std::string_view text);

/// The number of a decimal literal such as "-2.5e3"; empty for anything else, for octal and
/// hexadecimal look-alikes ("010", "0x10") and for numbers beyond the range.
std::optional<double> parse_number(std::string_view text);

}  // namespace buckens::base
