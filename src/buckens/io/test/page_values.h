// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace buckens::io::test {

/// The float32 numbers of a base64 text.
inline std::vector<float> decode(const std::string& text) {
  std::map<char, std::uint32_t> value;
  std::uint32_t next = 0;
  for (const char c :
       std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")) {
    value[c] = next++;
  }
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | value.at(c);
    have += 6;
    if (have >= 8) {
      have -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> have & 0xFFU));
    }
  }
  std::vector<float> numbers;
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    std::uint32_t word = 0;
    for (std::size_t b = 0; b < 4; ++b) word |= static_cast<std::uint32_t>(bytes[i + b]) << 8 * b;
    numbers.push_back(std::bit_cast<float>(word));
  }
  return numbers;
}

}  // namespace buckens::io::test
