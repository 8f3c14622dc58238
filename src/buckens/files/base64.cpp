// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/base64.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace buckens::files {

namespace {

constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string encode(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16 |
                                (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0U) |
                                (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0U);
    text += kDigits[group >> 18 & 63U];
    text += kDigits[group >> 12 & 63U];
    text += left > 1 ? kDigits[group >> 6 & 63U] : '=';
    text += left > 2 ? kDigits[group & 63U] : '=';
  }
  return text;
}

/// Appends the lowest `size` bytes, the least first.
void append(std::vector<std::uint8_t>& bytes, std::uint32_t bits, unsigned size) {
  for (unsigned k = 0; k < size; ++k) {
    bytes.push_back(static_cast<std::uint8_t>(bits >> 8 * k & 0xFFU));
  }
}

}  // namespace

std::string base64_int32(std::span<const int> values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  for (const int value : values) append(bytes, static_cast<std::uint32_t>(value), 4);
  return encode(bytes);
}

std::string base64_uint16(std::span<const std::uint16_t> values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const std::uint16_t value : values) append(bytes, value, 2);
  return encode(bytes);
}

std::string base64_float32(std::span<const double> values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  for (const double value : values) {
    append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  }
  return encode(bytes);
}

}  // namespace buckens::files
