// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/values.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/base/units.h"
#include "buckens/model/check/range.h"
#include "buckens/model_file/number_look_alikes.h"
#include "buckens/model_file/table.h"

namespace buckens::model_file {

namespace {

using base::Dimension;
using base::FieldNote;

// Elements, iterations and columns beyond this are slips, and int must hold them.
constexpr double kLargestInteger = 1e7;

std::string example_of(const Dimension& dimension) {
  static const std::vector<std::pair<Dimension, const char*>> examples = {
      {base::kLength, "75 mm"},
      {base::kMass, "0.36 kg"},
      {base::kTime, "0.1 ms"},
      {base::kAngle, "30 deg"},
      {base::kForce, "10 N"},
      {base::kTorque, "2 N m"},
      {base::kStress, "200 GPa"},
      {base::kFrequency, "50 Hz"},
      {base::kVelocity, "1.5 m/s"},
      {base::kAcceleration, "9.81 m/s^2"},
      {base::kAngularVelocity, "60 rpm"}};
  for (const auto& [known, example] : examples) {
    if (known == dimension) return example;
  }
  return ("1 " + base::si_unit(dimension)).substr(0, dimension == base::kNumber ? 1 : 40);
}

/// The part of the text that stands where a unit would, if it is none; else empty.
std::string unknown_unit(const std::string& text) {
  const std::size_t space = text.find_last_of(" \t");
  if (space == std::string::npos) return "";
  const std::string head = text.substr(0, text.find_last_not_of(" \t", space) + 1);
  const std::string last = text.substr(space + 1);
  if (head.empty() || std::string("+-*/^(,<>=&|?:").find(head.back()) != std::string::npos) {
    return "";
  }
  const std::size_t first_space = text.find_first_of(" \t");
  if (base::parse_number(text.substr(0, first_space))) {
    const std::string rest = text.substr(text.find_first_not_of(" \t", first_space));
    const bool is_operation = std::string("+-*/^<>=&|?:").find(rest[0]) != std::string::npos;
    return is_operation ? "" : rest;
  }
  return base::is_identifier(last) ? last : "";
}

[[noreturn]] void fail_unit(const ReadPlace& place, const FieldNote& note,
                            const std::string& unit) {
  std::string advice;
  if (unit.find('/') != std::string::npos && unit.find(' ') != std::string::npos) {
    advice = " After a slash every unit needs its own slash: kg/m/s.";
  } else if (base::is_identifier(unit)) {
    const std::string near = base::nearest(unit, base::unit_names());
    if (!near.empty()) advice = fmt::format(" Did you mean \"{}\"?", near);
  }
  fail(place, fmt::format("unknown unit \"{}\" in \"{}\".{} Expected {}", unit, place.node.text,
                          advice, expectation(note)));
}

/// SI value of the unit, after checking its dimension.
double unit_scale(const ReadPlace& place, const FieldNote& note, const std::string& text) {
  if (text.empty()) return 1.0;
  const auto unit = base::parse_unit(text);
  if (!unit) fail_unit(place, note, text);
  if (note.any_dimension || base::accepts(note.dimension, unit->dimension)) return unit->factor;
  const bool is_turn_rate =
      note.dimension == base::kAngularVelocity && unit->dimension == base::kFrequency;
  const std::string advice =
      is_turn_rate ? " (hertz count turns: write \"2*pi*50 rad/s\" or 3000 rpm for 50 Hz)" : "";
  fail(place, fmt::format("\"{}\" is {}{}; expected {}", place.node.text,
                          base::dimension_name(unit->dimension), advice, expectation(note)));
}

/// The text of a number; an expression does not show its value, which is put behind it.
std::string shown(const ReadPlace& place, double value) {
  const std::string& text = place.node.text;
  const bool is_plain = base::parse_number(base::split_quantity(text).formula).has_value();
  return is_plain ? text : fmt::format("{} = {:g}", text, value);
}

void check_range(const ReadPlace& place, const FieldNote& note, double value) {
  if (const auto rule = model::broken_rule(note, value)) {
    fail(place, model::refusal(shown(place, value), *rule));
  }
}

/// Texts that another program would read its own way.
void refuse_look_alikes(const ReadPlace& place, const FieldNote& note,
                        const base::Parameters& parameters) {
  const std::string& text = place.node.text;
  if (parameters.contains(text)) return;
  if (const auto found = look_alike_problem(text, expectation(note))) fail(place, *found);
}

void expect_scalar(const ReadPlace& place, const std::string& expected) {
  if (place.node.is_scalar() && !place.node.text.empty()) return;
  const std::string given =
      place.node.is_scalar() ? std::string("an empty text") : place.node.description();
  fail(place, fmt::format("expected {1}, found {0}", given, expected));
}

/// Whether a name occurs in a formula.
bool has_word(const std::string& formula, const std::string& name) {
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t at = formula.find(name); at != std::string::npos;
       at = formula.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool begins = at == 0 || !is_word(formula[at - 1]);
    if (begins && (end == formula.size() || !is_word(formula[end]))) return true;
  }
  return false;
}

/// A quantity without an expression in it; most are, and need no parser.
std::optional<double> plain_quantity(const ReadPlace& place, const FieldNote& note) {
  if (!place.node.is_scalar()) return std::nullopt;
  if (const auto number = base::parse_number(place.node.text)) return number;
  const base::QuantityText split = base::split_quantity(place.node.text);
  const auto number = base::parse_number(split.formula);
  if (!number || split.unit.empty()) return std::nullopt;
  return *number * unit_scale(place, note, split.unit);
}

}  // namespace

void fail(const ReadPlace& place, const std::string& message) {
  const std::string path = place.path.empty() ? "" : place.path + ": ";
  throw InputError(place.node.where, path + message);
}

std::string expectation(const FieldNote& note) {
  const std::string name =
      note.any_dimension ? "a number or quantity" : base::dimension_name(note.dimension);
  const bool is_single = !note.example.empty() && note.example[0] != '[' && note.example[0] != '"';
  const std::string word = note.word.empty() ? "" : fmt::format("{} or ", note.word);
  return word + name + " such as " +
         (is_single ? std::string(note.example) : example_of(note.dimension));
}

Formula read_formula(const ReadPlace& place, const FieldNote& note,
                     const std::vector<std::string>& variables, const ReadContext& context) {
  expect_scalar(place, expectation(note));
  refuse_look_alikes(place, note, context.parameters);
  const base::QuantityText split = base::split_quantity(place.node.text);
  if (const auto found = size_problem(split.formula)) fail(place, *found);
  if (const auto found = foreign_character_problem(split.formula, true)) fail(place, *found);
  const double scale = unit_scale(place, note, split.unit);
  if (split.unit.empty()) {
    const std::string unit = unknown_unit(place.node.text);
    if (!unit.empty()) fail_unit(place, note, unit);
  }
  if (const auto found = foreign_character_problem(split.formula, false)) fail(place, *found);
  SourceLocation where = place.node.where;
  if (where.line > 0 && place.node.is_quoted) where.column += 1;
  try {
    return {base::Expression(split.formula, variables, context.parameters, where), scale};
  } catch (const InputError& error) {
    // The place is prepended again, so it is removed here.
    const std::string prefix = error.where().empty() ? "" : error.where().text() + ": ";
    std::string text = std::string(error.what()).substr(prefix.size());
    if (text.back() != '.' && text.back() != '?') text += '.';
    throw InputError(error.where(),
                     fmt::format("{}: {} Expected {}", place.path, text, expectation(note)));
  }
}

double read_quantity(const ReadPlace& place, const FieldNote& note, const ReadContext& context) {
  if (!note.word.empty() && place.node.is_scalar() && place.node.text == note.word) return 0.0;
  double value = 0;
  if (const auto number =
          place.node.is_scalar() ? base::parse_number(place.node.text) : std::nullopt) {
    value = *number;
  } else {
    const Formula formula = read_formula(place, note, {}, context);
    value = formula.scale * formula.expression({});
  }
  check_range(place, note, value);
  return value;
}

body::FrameDivision read_frames(const ReadPlace& place, const FieldNote& note,
                                const ReadContext& context) {
  const std::string word = body::FrameDivision::kPerElement;
  const std::string& text = place.node.text;
  if (place.node.is_scalar() && text == word) return body::FrameDivision::each_element();
  const bool is_word = place.node.is_scalar() && !text.empty() &&
                       text.find_first_not_of(
                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                           "-_ ") == std::string::npos;
  if (is_word && !context.parameters.contains(text)) {
    fail(place, fmt::format("\"{}\" is not a number of frames; expected a whole number or {}", text,
                            word));
  }
  return read_integer(place, note, context);
}

int read_integer(const ReadPlace& place, const FieldNote& note, const ReadContext& context) {
  const double value = read_quantity(place, note, context);
  if (value != std::round(value) || std::abs(value) > kLargestInteger) {
    fail(place, fmt::format("{} is not a whole number of reasonable size", shown(place, value)));
  }
  return static_cast<int>(value);
}

bool read_truth(const ReadPlace& place, const FieldNote& note) {
  const std::string expected = note.is_switch ? "on or off" : "true or false";
  expect_scalar(place, expected);
  const std::string& text = place.node.text;
  if (text == "true" || (note.is_switch && text == "on")) return true;
  if (text == "false" || (note.is_switch && text == "off")) return false;
  fail(place, fmt::format("expected {1}, found \"{0}\"", text, expected));
}

std::string read_text(const ReadPlace& place) {
  expect_scalar(place, "a text");
  return place.node.text;
}

std::size_t read_choice(const ReadPlace& place, const std::vector<std::string>& allowed,
                        const std::vector<std::string>& planned) {
  expect_scalar(place, fmt::format("one of {}", fmt::join(allowed, ", ")));
  const std::string& text = place.node.text;
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (allowed[i] == text) return i;
  }
  if (std::find(planned.begin(), planned.end(), text) != planned.end()) {
    fail(place, fmt::format("\"{}\" is not available yet; choose one of {}", text,
                            fmt::join(allowed, ", ")));
  }
  const std::string near = base::nearest(text, allowed);
  fail(place, fmt::format("must be one of {1}, not \"{0}\".{2}", text, fmt::join(allowed, ", "),
                          near.empty() ? "" : fmt::format(" Did you mean \"{}\"?", near)));
}

base::TimeLaw read_time_law(const ReadPlace& place, const FieldNote& note,
                            const ReadContext& context) {
  if (place.node.is_map()) return read_table_law(place, note, context);
  if (!place.node.is_scalar()) {
    fail(place, fmt::format("expected {1}, an expression of t, or a table, found {0}",
                            place.node.description(), expectation(note)));
  }
  if (const auto plain = plain_quantity(place, note)) {
    check_range(place, {}, *plain);
    return base::TimeLaw::constant(*plain);
  }
  Formula formula = read_formula(place, note, {"t"}, context);
  // Every run needs the value at its beginning, so a bad one is bad input.
  const double first = formula.scale * formula.expression.unchecked({0.0});
  if (!std::isfinite(first)) {
    fail(place,
         fmt::format("\"{}\" has the value {} at t = 0; it must be finite (division by zero?)",
                     place.node.text, first));
  }
  return base::TimeLaw::expression(std::move(formula.expression), formula.scale);
}

base::SignalLaw read_signal_law(const ReadPlace& place, const FieldNote& note,
                                const ReadContext& context) {
  base::SignalLaw out;
  const bool is_text = place.node.is_scalar();
  const base::QuantityText written =
      is_text ? base::split_quantity(place.node.text) : base::QuantityText{};
  const std::string& text = written.formula;
  if (note.any_dimension && !written.unit.empty()) {
    if (const auto unit = base::parse_unit(written.unit)) out.unit = unit->dimension;
  }
  if (is_text && !plain_quantity(place, note)) {
    for (std::size_t k = 0; k < context.signals.size(); ++k) {
      if (!has_word(text, context.signals[k])) continue;
      out.names.push_back(context.signals[k]);
      out.places.push_back(static_cast<int>(k));
    }
  }
  if (out.names.empty()) {
    out.law = read_time_law(place, note, context);
    if (!is_text) return out;
    // A formula of parameters alone is a number.
    if (!has_word(text, "t")) out.law = base::TimeLaw::constant(out.law.value(0.0));
    if (out.law.is_constant()) check_range(place, note, out.law.value(0.0));
    return out;
  }
  if (out.names.size() > base::SignalLaw::kMostSignals) {
    fail(place, fmt::format("the formula uses {} signals, but at most {} are allowed; turn parts "
                            "of it into signals",
                            out.names.size(), base::SignalLaw::kMostSignals));
  }
  std::vector<std::string> variables = {"t"};
  variables.insert(variables.end(), out.names.begin(), out.names.end());
  Formula formula = read_formula(place, note, variables, context);
  out.formula = std::move(formula.expression);
  out.scale = formula.scale;
  return out;
}

base::Characteristic read_characteristic(const ReadPlace& place, const FieldNote& note,
                                         const ReadContext& context) {
  if (place.node.is_map()) return base::Characteristic::table(read_table_law(place, note, context));
  const char* displacement = note.dimension == base::kTorque ? "angle" : "displacement";
  if (!place.node.is_scalar()) {
    fail(place, fmt::format("expected {1}, an expression of {2} and rate, or a table, found {0}",
                            place.node.description(), expectation(note), displacement));
  }
  Formula formula = read_formula(place, note, {displacement, "rate"}, context);
  // Every run needs the value at its beginning, and energies count from it.
  const double first = formula.scale * formula.expression.unchecked({0.0, 0.0});
  if (!std::isfinite(first)) {
    fail(place, fmt::format("\"{}\" has the value {} at {} = 0; it must be finite (division by "
                            "zero?)",
                            place.node.text, first, displacement));
  }
  return base::Characteristic::formula(std::move(formula.expression), formula.scale);
}

model::PositionLaw read_position_law(const ReadPlace& place, const FieldNote& note,
                                     const ReadContext& context) {
  Formula formula = read_formula(place, note, {"x", "y", "z"}, context);
  return {std::move(formula.expression), formula.scale, true};
}

}  // namespace buckens::model_file
