// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/number_look_alikes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/units.h"

namespace buckens::model_file {

namespace {

struct ForeignCharacter {
  std::string_view text;
  const char* code;
  const char* remedy;
  bool is_of_units = false;
};

constexpr std::array<ForeignCharacter, 15> kForeignCharacters = {{
    {"\u2212", "U+2212", "-"},
    {"\u2010", "U+2010", "-"},
    {"\u2013", "U+2013", "-"},
    {"\u2014", "U+2014", "-"},
    {"\u00a0", "U+00A0", "a blank"},
    {"\u2009", "U+2009", "a blank"},
    {"\u202f", "U+202F", "a blank"},
    {"\u00d7", "U+00D7", "*"},
    {"\u22c5", "U+22C5", "*"},
    {"\u00f7", "U+00F7", "/"},
    {"\u221a", "U+221A", "sqrt()"},
    {"\u03c0", "U+03C0", "pi"},
    {"\u00b7", "U+00B7", "*", true},
    {"\u00b2", "U+00B2", "^2", true},
    {"\u00b3", "U+00B3", "^3", true},
}};

constexpr std::array<std::string_view, 14> kWords = {"yes",   "no",   "on",   "off",  "true",
                                                     "false", "null", "~",    "nan",  ".nan",
                                                     "inf",   ".inf", "-inf", "-.inf"};

std::string_view without_sign(std::string_view text) {
  return text.substr(text.starts_with('+') || text.starts_with('-') ? 1 : 0);
}

/// What reading a decimal literal ends with; invalid_argument for any other text.
std::errc literal_error(std::string_view text) {
  const std::string_view digits = without_sign(text);
  const bool has_number =
      !digits.empty() && std::string_view("0123456789.").find(digits[0]) != std::string_view::npos;
  double value = 0;
  const char* last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  return has_number && end == last ? error : std::errc::invalid_argument;
}

}  // namespace

std::optional<std::string> look_alike_problem(const std::string& text,
                                              const std::string& expected) {
  const std::string_view digits = without_sign(text);
  if (literal_error(text) == std::errc() && !base::parse_number(text)) {
    const std::size_t significant = std::min(digits.find_first_not_of('0'), digits.size() - 1);
    return fmt::format("{} could be meant as an octal number; write {}", text,
                       digits.substr(significant));
  }
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos && comma + 1 < text.size() && comma > 0 &&
      base::parse_number(std::string(text).replace(comma, 1, "."))) {
    return fmt::format("{} has a decimal comma; write {}", text,
                       std::string(text).replace(comma, 1, "."));
  }
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::find(kWords.begin(), kWords.end(), lower) != kWords.end()) {
    return fmt::format("\"{}\" is not a number; expected {}", text, expected);
  }
  return std::nullopt;
}

std::optional<std::string> size_problem(const std::string& formula) {
  if (literal_error(formula) != std::errc::result_out_of_range) return std::nullopt;
  return fmt::format("{} is outside the range of numbers, 1e-308 to 1e308", formula);
}

std::optional<std::string> foreign_character_problem(const std::string& formula, bool has_unit) {
  for (std::size_t i = 0; i < formula.size(); ++i) {
    for (const ForeignCharacter& foreign : kForeignCharacters) {
      if (std::string_view(formula).substr(i, foreign.text.size()) != foreign.text) continue;
      if (foreign.is_of_units && has_unit) continue;
      return fmt::format("\"{}\" contains the character \"{}\" ({}); write {} instead", formula,
                         foreign.text, foreign.code, foreign.remedy);
    }
  }
  return std::nullopt;
}

std::optional<std::string> cut_item_problem(const YamlNode& list, int count) {
  const std::vector<YamlNode>& items = list.items;
  int pairs = 0;
  std::size_t first = 0;
  for (std::size_t k = 0; k + 1 < items.size(); ++k) {
    const YamlNode& left = items[k];
    const YamlNode& right = items[k + 1];
    if (!left.is_scalar() || !right.is_scalar() || left.is_quoted || right.is_quoted) continue;
    const auto number = [](const std::string& text, char c) {
      return std::count(text.begin(), text.end(), c);
    };
    if (number(left.text, '(') > number(left.text, ')') &&
        number(right.text, ')') > number(right.text, '(')) {
      return fmt::format(
          "the comma in {},{} cuts the expression in two; put it in quotes: \"{}, {}\"", left.text,
          right.text, left.text, right.text);
    }
    const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    const std::string_view whole = without_sign(left.text);
    const bool is_tight =
        left.where.line == right.where.line &&
        right.where.column == left.where.column + static_cast<int>(left.text.size()) + 1;
    if (is_tight && !whole.empty() && std::all_of(whole.begin(), whole.end(), is_digit) &&
        is_digit(right.text[0])) {
      if (pairs++ == 0) first = k;
    }
  }
  if (pairs == 0 || static_cast<int>(items.size()) - pairs != count) return std::nullopt;
  return fmt::format("{},{} is read as two items; write decimals with a point: {}.{}",
                     items[first].text, items[first + 1].text, items[first].text,
                     items[first + 1].text);
}

}  // namespace buckens::model_file
