// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/number.h"

#include <charconv>
#include <cmath>

namespace buckens::mesh_io {

namespace {

constexpr std::size_t kLongestReal = 48;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool has_digit(std::string_view text) {
  for (const char c : text) {
    if (is_digit(c)) return true;
  }
  return false;
}

}  // namespace

std::optional<std::int64_t> nastran_integer(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with("+")) return std::nullopt;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> nastran_real(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || text.size() > kLongestReal) return std::nullopt;
  std::string joined;
  if (const std::size_t blank = text.find(' '); blank != std::string_view::npos) {
    // NASTRAN-95 has blanks before an exponent: "20.0 E+7", "10.4  +6".
    const std::string_view exponent = trimmed(text.substr(blank));
    if (exponent.empty() ||
        std::string_view("eEdD+-").find(exponent[0]) == std::string_view::npos) {
      return std::nullopt;
    }
    joined = text.substr(0, blank);
    joined += exponent;
    text = joined;
  }
  // The mantissa up to an exponent letter or to a sign that is not the first character.
  std::size_t split = 0;
  while (split < text.size() &&
         (is_digit(text[split]) || text[split] == '.' || (split == 0 && text[0] == '-'))) {
    ++split;
  }
  if (!has_digit(text.substr(0, split))) return std::nullopt;
  std::string_view exponent = text.substr(split);
  std::string standard(text.substr(0, split));
  if (!exponent.empty()) {
    const bool has_letter = std::string_view("eEdD").find(exponent[0]) != std::string_view::npos;
    if (has_letter) exponent.remove_prefix(1);
    if (exponent.empty() || (!has_letter && exponent[0] != '+' && exponent[0] != '-')) {
      return std::nullopt;
    }
    standard += 'e';
    standard += exponent;
  }
  double value = 0;
  const char* const last = standard.data() + standard.size();
  // from_chars takes "e+5" but neither "inf" nor "nan" after the check of the mantissa.
  const auto [end, error] = std::from_chars(standard.data(), last, value);
  if (error == std::errc::result_out_of_range && end == last && exponent.starts_with('-')) {
    return 0.0;
  }
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string quoted_excerpt(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string out = "\"";
  for (const char c : text.substr(0, kMost)) out += c < ' ' || c > '~' ? '?' : c;
  if (text.size() > kMost) out += "...";
  return out + '"';
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return out;
}

}  // namespace buckens::mesh_io
