// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace buckens::files {

/// A number as written by finite-element programs: "1", "-1.", ".5", "+2.5E+3", "1.0D-5".
/// @return empty if the text is anything else, or not finite
std::optional<double> deck_number(std::string_view text);

/// An integer with or without sign; empty if it is anything else or exceeds 64 bits.
std::optional<std::int64_t> deck_integer(std::string_view text);

/// The text with blanks, tabs and carriage returns trimmed at both ends.
std::string_view stripped(std::string_view text);

}  // namespace buckens::files
