// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace buckens::files {

/// A number as finite-element programs write it: "1", "-1.", ".5", "+2.5E+3", "1.0D-5".
/// @return none if the text is anything else, or not finite
std::optional<double> deck_number(std::string_view text);

/// A whole number with or without sign; none if it is anything else or beyond 64 bits.
std::optional<std::int64_t> deck_integer(std::string_view text);

/// Without blanks, tabs and carriage returns at both ends.
std::string_view stripped(std::string_view text);

}  // namespace buckens::files
