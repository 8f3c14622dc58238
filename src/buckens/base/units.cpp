// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

namespace buckens::base {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPound = 0.45359237;
constexpr double kGravity = 9.80665;
constexpr double kInch = 0.0254;
constexpr std::size_t kLongestUnit = 60;

using UnitTable = std::map<std::string, Unit, std::less<>>;

const UnitTable& units() {
  static const UnitTable table = {
      {"m", {1, kLength}},
      {"mm", {1e-3, kLength}},
      {"cm", {1e-2, kLength}},
      {"km", {1e3, kLength}},
      {"um", {1e-6, kLength}},
      {"µm", {1e-6, kLength}},
      {"nm", {1e-9, kLength}},
      {"in", {kInch, kLength}},
      {"ft", {12 * kInch, kLength}},
      {"kg", {1, kMass}},
      {"g", {1e-3, kMass}},
      {"mg", {1e-6, kMass}},
      {"tonne", {1e3, kMass}},
      {"lb", {kPound, kMass}},
      {"s", {1, kTime}},
      {"ms", {1e-3, kTime}},
      {"us", {1e-6, kTime}},
      {"µs", {1e-6, kTime}},
      {"min", {60, kTime}},
      {"h", {3600, kTime}},
      {"rad", {1, kAngle}},
      {"mrad", {1e-3, kAngle}},
      {"deg", {kPi / 180, kAngle}},
      {"°", {kPi / 180, kAngle}},
      {"rev", {2 * kPi, kAngle}},
      {"rpm", {2 * kPi / 60, kAngularVelocity}},
      {"Hz", {1, kFrequency}},
      {"kHz", {1e3, kFrequency}},
      {"N", {1, kForce}},
      {"mN", {1e-3, kForce}},
      {"kN", {1e3, kForce}},
      {"MN", {1e6, kForce}},
      {"lbf", {kPound * kGravity, kForce}},
      {"Nm", {1, kTorque}},
      {"J", {1, kTorque}},
      {"kJ", {1e3, kTorque}},
      {"W", {1, kTorque / kTime}},
      {"kW", {1e3, kTorque / kTime}},
      {"Pa", {1, kStress}},
      {"kPa", {1e3, kStress}},
      {"MPa", {1e6, kStress}},
      {"GPa", {1e9, kStress}},
      {"bar", {1e5, kStress}},
      {"psi", {kPound * kGravity / (kInch * kInch), kStress}},
      {"ksi", {1e3 * kPound * kGravity / (kInch * kInch), kStress}},
      {"%", {1e-2, kNumber}},
  };
  return table;
}

/// Walks along a product of units.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : text_(text) {}

  std::optional<Unit> read() {
    Unit out;
    bool divides = false;
    bool has_divided = false;
    for (bool is_first = true;; is_first = false) {
      skip_space();
      if (!is_first) {
        if (at_end()) return out;
        divides = take('/');
        if (!divides && !take_product()) {
          if (!had_space_) return std::nullopt;
        }
        if (has_divided && !divides) return std::nullopt;
        has_divided = has_divided || divides;
        skip_space();
      }
      const std::optional<Unit> factor = read_factor(is_first);
      if (!factor) return std::nullopt;
      out.factor = divides ? out.factor / factor->factor : out.factor * factor->factor;
      out.dimension =
          divides ? out.dimension / factor->dimension : out.dimension * factor->dimension;
    }
  }

 private:
  bool at_end() const { return position_ >= text_.size(); }

  void skip_space() {
    had_space_ = false;
    while (!at_end() && text_[position_] == ' ') {
      ++position_;
      had_space_ = true;
    }
  }

  bool take(char c) {
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    return true;
  }

  bool take_text(std::string_view word) {
    if (text_.substr(position_, word.size()) != word) return false;
    position_ += word.size();
    return true;
  }

  bool take_product() { return take('*') || take_text("·"); }

  /// A name, perhaps with an exponent; "1" where a fraction begins.
  std::optional<Unit> read_factor(bool is_first) {
    if (is_first && take('1')) {
      const bool is_fraction = position_ < text_.size() && text_[position_] == '/';
      return is_fraction ? std::optional<Unit>(Unit{}) : std::nullopt;
    }
    const std::size_t begin = position_;
    while (!at_end() && is_name_character()) ++position_;
    const auto found = units().find(text_.substr(begin, position_ - begin));
    if (found == units().end()) return std::nullopt;
    const std::optional<int> exponent = read_exponent();
    if (!exponent) return std::nullopt;
    Unit out;
    for (int i = 0; i < std::abs(*exponent); ++i) {
      const bool divides = *exponent < 0;
      out.factor = divides ? out.factor / found->second.factor : out.factor * found->second.factor;
      out.dimension = divides ? out.dimension / found->second.dimension
                              : out.dimension * found->second.dimension;
    }
    return out;
  }

  bool is_name_character() const {
    const auto c = static_cast<unsigned char>(text_[position_]);
    if (text_.substr(position_, 2) == "²" || text_.substr(position_, 2) == "³" ||
        text_.substr(position_, 2) == "·") {
      return false;
    }
    return std::isalpha(c) != 0 || c == '%' || c >= 0x80;
  }

  std::optional<int> read_exponent() {
    if (take_text("²")) return 2;
    if (take_text("³")) return 3;
    if (!take('^')) return 1;
    int exponent = 0;
    const char* begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), exponent);
    if (error != std::errc() || exponent == 0 || std::abs(exponent) > 9) return std::nullopt;
    position_ += static_cast<std::size_t>(end - begin);
    return exponent;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  bool had_space_ = false;
};

std::string_view trim(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

bool ends_with_operator(std::string_view text) {
  return !text.empty() &&
         std::string_view("+-*/^(,<>=&|?:!").find(text.back()) != std::string_view::npos;
}

/// Length of the decimal literal at the beginning, 0 if there is none.
std::size_t literal_length(std::string_view text) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t begin = i;
    while (i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0) ++i;
    return i - begin;
  };
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  std::size_t count = digits();
  if (i < text.size() && text[i] == '.') {
    ++i;
    count += digits();
  }
  if (count == 0) return 0;
  const std::size_t mantissa = i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    if (digits() == 0) i = mantissa;
  }
  return i;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  text = trim(text);
  if (text.empty() || text.size() > kLongestUnit) return std::nullopt;
  std::string known(text);
  // Greek keyboards and Unicode's own normalisation write the letter μ, not the prefix µ.
  for (std::size_t i = 0; (i = known.find("\u03bc", i)) != std::string::npos;) {
    known.replace(i, 2, "\u00b5");
  }
  return UnitReader(known).read();
}

const std::vector<std::string>& unit_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& [name, unit] : units()) out.push_back(name);
    return out;
  }();
  return names;
}

QuantityText split_quantity(std::string_view text) {
  text = trim(text);
  const std::size_t number = literal_length(text);
  if (number > 0 && parse_unit(text.substr(number))) {
    return {std::string(text.substr(0, number)), std::string(trim(text.substr(number)))};
  }
  const std::size_t rest = std::min(text.find_first_not_of(" \t", number), text.size());
  const bool is_number_and_word = number > 0 && rest > number && rest < text.size() &&
                                  std::isalpha(static_cast<unsigned char>(text[rest])) != 0;
  // "3 kg/m s" is a number with a bad unit, not "3 kg/m" in seconds.
  if (is_number_and_word) return {std::string(text), ""};
  // A unit is short: looking at the ending only keeps the cost linear.
  const std::size_t begin = text.size() > kLongestUnit ? text.size() - kLongestUnit : 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] != ' ' && text[i] != '\t') continue;
    const std::string_view head = trim(text.substr(0, i));
    const std::string_view ending = trim(text.substr(i));
    if (head.empty() || ends_with_operator(head) || !parse_unit(ending)) continue;
    return {std::string(head), std::string(ending)};
  }
  return {std::string(text), ""};
}

std::optional<double> parse_number(std::string_view text) {
  text = trim(text);
  if (text.empty() || literal_length(text) != text.size()) return std::nullopt;
  if (text.front() == '+') text.remove_prefix(1);
  const std::string_view digits = text.front() == '-' ? text.substr(1) : text;
  const bool is_octal_look_alike =
      digits.size() > 1 && digits[0] == '0' && std::isdigit(static_cast<unsigned char>(digits[1]));
  if (is_octal_look_alike) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace buckens::base
