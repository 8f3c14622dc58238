// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace buckens::files {

/// Base64 (RFC 4648, with padding) of the numbers as consecutive little-endian float32.
/// Numbers beyond the range of float32 become infinite.
std::string base64_float32(std::span<const double> values);

/// The same for integers as little-endian int32 and uint16.
std::string base64_int32(std::span<const int> values);
std::string base64_uint16(std::span<const std::uint16_t> values);

}  // namespace buckens::files
