// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "buckens/base/source_location.h"

namespace buckens::base {

/// Values of `parameters:` by name, SI.
using Parameters = std::map<std::string, double>;

/// A formula in named variables, parsed once.
///
/// Understands + − * / ^, comparisons, ?:, the functions of muParser (sin, cos, exp, sqrt, abs,
/// min, max, …), the constant pi and the given parameters. Copies share the parsed formula;
/// evaluation is const and may run in several threads at once.
class Expression {
 public:
  /// The constant zero.
  Expression() = default;

  /// @param text formula without a unit
  /// @param variables names in the order in which operator() takes their values
  /// @param where location for messages; its column is that of the first character of `text`
  /// @throws InputError on syntax errors, unknown names (with the nearest known one), and formulas
  ///         without variables whose value is not finite
  Expression(const std::string& text, const std::vector<std::string>& variables,
             const Parameters& parameters, const SourceLocation& where);

  /// @throws NumericalError naming the formula, its place, the variables and the value if the value
  ///         is not finite
  double operator()(std::initializer_list<double> values) const;

  /// The same, but returns infinities and NaNs unchanged.
  double unchecked(std::initializer_list<double> values) const;

  /// True if the formula contains no variable.
  bool is_constant() const;
  const std::string& text() const;
  const SourceLocation& where() const;

 private:
  struct Parsed;
  std::shared_ptr<const Parsed> parsed_;
};

/// True if `name` can be a parameter: letters, digits and _, not starting with a digit.
bool is_identifier(const std::string& name);

/// Reserved names: the functions and constants available in every expression, and the variables
/// t, x, y and z. Parameters cannot have them.
const std::vector<std::string>& reserved_names();

}  // namespace buckens::base
