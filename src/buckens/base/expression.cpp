// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <mutex>
#include <numbers>

#include <fmt/format.h>
#include <muParser.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/base/units.h"

namespace buckens::base {

namespace {

constexpr double kE = 2.71828182845904523536;
constexpr std::size_t kLongestFormula = 20000;

SourceLocation shifted(SourceLocation where, int columns) {
  if (where.line > 0) where.column += std::max(0, columns);
  return where;
}

/// muParser supports assignments ("t = 3"), strings and lists of results; a law of time has no use
/// for them, and an assignment would change the meaning of the formula from then on.
void refuse_statements(const std::string& text, const SourceLocation& where) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i > 0 ? text[i - 1] : ' ';
    const char after = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool is_comparison =
        before == '=' || before == '<' || before == '>' || before == '!' || after == '=';
    if ((text[i] == '=' && !is_comparison) || text[i] == '"' || text[i] == '#') {
      throw InputError(shifted(where, static_cast<int>(i)),
                       fmt::format("expression \"{}\": '{}' has no meaning here; equality is ==",
                                   text, text[i]));
    }
  }
  if (text.size() > kLongestFormula) {
    throw InputError(
        where, fmt::format("an expression of {} characters is too long; use a table", text.size()));
  }
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Finds unknown names before muParser does: it reports an unknown function as a stray parenthesis.
void refuse_unknown_names(const std::string& text, const std::vector<std::string>& variables,
                          const Parameters& parameters, const SourceLocation& where) {
  std::vector<std::string> own = variables;
  for (const auto& [name, value] : parameters) own.push_back(name);
  std::vector<std::string> names = own;
  for (const std::string& name : reserved_names()) {
    // The variables t, x, y, z are known only where the formula has them.
    if (name.size() > 1 || name == "e") names.push_back(name);
  }
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_word(text[end])) ++end;
    const std::string word = text.substr(i, end - i);
    if (is_identifier(word) && std::find(names.begin(), names.end(), word) == names.end()) {
      if (parse_unit(word)) {
        throw InputError(shifted(where, static_cast<int>(i)),
                         fmt::format("expression \"{}\": unknown name \"{}\"; if this is a unit, "
                                     "write it at the end after a space",
                                     text, word));
      }
      throw InputError(shifted(where, static_cast<int>(i)),
                       fmt::format("expression \"{}\": unknown name \"{}\".{}", text, word,
                                   nearest(word, names).empty() ? suggestion(word, own)
                                                                : suggestion(word, names)));
    }
    // Words that begin with a digit are numbers: 2e3.
    i = std::max(end, i + 1);
  }
}

}  // namespace

struct Expression::Parsed {
  std::string text;
  SourceLocation where;
  std::vector<std::string> names;
  mutable std::mutex mutex;  // muParser keeps the variables' values inside
  mutable std::vector<double> slots;
  mutable mu::Parser parser;
  bool is_constant = false;
  double constant = 0;
};

Expression::Expression(const std::string& text, const std::vector<std::string>& variables,
                       const Parameters& parameters, const SourceLocation& where) {
  refuse_statements(text, where);
  refuse_unknown_names(text, variables, parameters, where);
  auto parsed = std::make_shared<Parsed>();
  parsed->text = text;
  parsed->where = where;
  parsed->names = variables;
  parsed->slots.assign(variables.size(), 0.0);
  try {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      parsed->parser.DefineVar(variables[i], &parsed->slots[i]);
    }
    parsed->parser.DefineConst("pi", std::numbers::pi);
    parsed->parser.DefineConst("e", kE);
    for (const auto& [name, value] : parameters) parsed->parser.DefineConst(name, value);
    parsed->parser.SetExpr(text);
    parsed->is_constant = parsed->parser.GetUsedVar().empty();
    parsed->constant = parsed->parser.Eval();
    if (parsed->parser.GetNumResults() > 1) {
      throw InputError(where, fmt::format("expression \"{}\": the comma separates arguments of "
                                          "functions; decimals are written 1.5",
                                          text));
    }
  } catch (const mu::Parser::exception_type& error) {
    throw InputError(shifted(where, static_cast<int>(error.GetPos())),
                     fmt::format("expression \"{}\": {}", text, error.GetMsg()));
  }
  if (parsed->is_constant && !std::isfinite(parsed->constant)) {
    throw InputError(
        where,
        fmt::format("expression \"{}\" has the value {}; it must be finite (division by zero?)",
                    text, parsed->constant));
  }
  parsed_ = std::move(parsed);
}

double Expression::unchecked(std::initializer_list<double> values) const {
  if (!parsed_) return 0.0;
  if (parsed_->is_constant) return parsed_->constant;
  BUCKENS_ASSERT(values.size() == parsed_->slots.size());
  const std::lock_guard lock(parsed_->mutex);
  std::copy(values.begin(), values.end(), parsed_->slots.begin());
  return parsed_->parser.Eval();
}

double Expression::operator()(std::initializer_list<double> values) const {
  const double value = unchecked(values);
  if (std::isfinite(value)) return value;
  std::string at;
  std::size_t i = 0;
  for (const double x : values) {
    at += fmt::format("{}{} = {:.9g}", i == 0 ? "" : ", ", parsed_->names[i], x);
    ++i;
  }
  throw NumericalError(parsed_->where,
                       fmt::format("expression \"{}\" has the value {} at {}; it must be finite "
                                   "(division by zero, root or logarithm of a negative number?)",
                                   parsed_->text, value, at));
}

bool Expression::is_constant() const { return !parsed_ || parsed_->is_constant; }

const std::string& Expression::text() const {
  static const std::string zero = "0";
  return parsed_ ? parsed_->text : zero;
}

const SourceLocation& Expression::where() const {
  static const SourceLocation nowhere;
  return parsed_ ? parsed_->where : nowhere;
}

bool is_identifier(const std::string& name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), is_word);
}

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out = {"t", "x", "y", "z", "pi", "e", "_pi", "_e"};
    const mu::Parser parser;
    for (const auto& [name, function] : parser.GetFunDef()) out.push_back(name);
    return out;
  }();
  return names;
}

}  // namespace buckens::base
