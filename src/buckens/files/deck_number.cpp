// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/deck_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace buckens::files {

namespace {

/// Longer texts are no numbers that a program has written.
constexpr std::size_t kLongestNumber = 64;

std::string_view without_plus(std::string_view text) {
  const bool is_signed = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return is_signed ? text.substr(1) : text;
}

}  // namespace

std::optional<double> deck_number(std::string_view text) {
  text = without_plus(text);
  std::array<char, kLongestNumber> copy;
  if (text.find_first_of("dD") != std::string_view::npos) {
    if (text.size() > copy.size()) return std::nullopt;
    std::replace_copy_if(
        text.begin(), text.end(), copy.begin(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    text = {copy.data(), text.size()};
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end) {
    // Numbers too small to be told from zero are zero; too large ones are not numbers.
    const bool is_small =
        text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
    return is_small ? std::optional(0.0) : std::nullopt;
  }
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> deck_integer(std::string_view text) {
  text = without_plus(text);
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::string_view stripped(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

}  // namespace buckens::files
