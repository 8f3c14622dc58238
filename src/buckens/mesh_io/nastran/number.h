// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace buckens::mesh_io {

/// The value of an integer field such as "12" or "-3"; empty for anything else and beyond 64 bits.
std::optional<std::int64_t> nastran_integer(std::string_view text);

/// The value of a real field: "1.0", ".5", "1.-3", "1.0+5", "2.5D3"; also integers. Empty for
/// anything else, for "nan" and "inf" and for numbers beyond the range.
std::optional<double> nastran_real(std::string_view text);

/// At most forty characters of a text in quotation marks, what cannot be printed as "?".
std::string quoted_excerpt(std::string_view text);

/// The text trimmed of white space.
std::string_view trimmed(std::string_view text);

/// Upper case of ASCII letters.
std::string upper_case(std::string_view text);

}  // namespace buckens::mesh_io
