// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace buckens::page::test {

/// The bytes of a base64 text.
inline std::vector<std::uint8_t> decode_bytes(const std::string& text) {
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
  return bytes;
}

/// Its little-endian numbers.
template <class Number>
std::vector<Number> decode_as(const std::string& text) {
  const std::vector<std::uint8_t> bytes = decode_bytes(text);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

inline std::vector<float> decode(const std::string& text) { return decode_as<float>(text); }
inline std::vector<int> decode_ints(const std::string& text) { return decode_as<int>(text); }
inline std::vector<std::uint16_t> decode_codes(const std::string& text) {
  return decode_as<std::uint16_t>(text);
}

}  // namespace buckens::page::test
