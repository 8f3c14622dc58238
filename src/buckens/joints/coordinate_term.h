// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/time_law.h"
#include "buckens/joints/turn_sum.h"

namespace buckens::joints {

/// A function of a joint coordinate: a polynomial, or a natural cubic spline through points.
class CoordinateFunction {
 public:
  /// @param coefficients of 1, x, x², …
  static CoordinateFunction polynomial(std::vector<double> coefficients);
  /// @param points (x, y), x increasing, at least two; @param owner for messages: `joint "track"`
  static CoordinateFunction table(const std::vector<std::array<double, 2>>& points,
                                  std::string owner = {});

  /// @throws NumericalError outside a table
  double value(double x) const;
  double slope(double x) const;
  double curvature(double x) const;

 private:
  void require(double x) const;

  std::vector<double> coefficients_;
  std::optional<base::TimeLaw> table_;  // of x in place of t
  double first_ = 0, last_ = 0;         // of the table
  std::string owner_;
};

/// Term of one coordinate in a coupler: c ξ, or f(ξ).
struct CoordinateTerm {
  double factor = 1;
  std::optional<CoordinateFunction> function;  ///< in place of the factor

  /// dg/dξ and d²g/dξ²
  double slope(double x) const { return function ? function->slope(x) : factor; }
  double curvature(double x) const { return function ? function->curvature(x) : 0.0; }
};

/// The sum that a coupler keeps at zero.
class CouplerSum {
 public:
  /// Adds the value of a term for a coordinate.
  void add(const CoordinateTerm& term, const CountedValue& value) {
    if (term.function) {
      functions_ += term.function->value(value.value());
    } else {
      linear_.add(term.factor, value);
    }
  }
  double value() const { return linear_.value() + functions_; }

 private:
  TurnSum linear_;
  double functions_ = 0;
};

}  // namespace buckens::joints
