// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/expression.h"
#include "buckens/base/source_location.h"

namespace buckens::base {

/// Interpolation of a table of points.
enum class Interpolation { linear, spline };

constexpr std::array<const char*, 2> choice_names(Interpolation) { return {"linear", "spline"}; }

/// Extrapolation of a table outside its time range: an error, or its first and last value.
enum class Extrapolation { refuse, hold };

constexpr std::array<const char*, 2> choice_names(Extrapolation) { return {"refuse", "hold"}; }

/// Times for which a law is defined, and its location in the model file.
struct TimeRange {
  double first = 0, last = 0;  ///< [s]
  SourceLocation where;
};

/// A prescribed function of time, f(t), with its first two derivatives.
///
/// Copies are cheap and share their data. Evaluation is const, always returns the same value for
/// the same time, and may run in several threads at once.
class TimeLaw {
 public:
  /// Contents of a law; see time_law.cpp.
  class Body;

  /// Zero at all times.
  TimeLaw() = default;

  static TimeLaw constant(double value);

  /// scale · expression(t). The expression has exactly the variable t.
  ///
  /// The derivatives come from extrapolated central differences (Ridders 1982), good to about 1e-11
  /// of the law's own magnitude over its own time scale for smooth expressions; they straddle t, so
  /// within the last attempted distance of a kink they are averages of both sides.
  static TimeLaw expression(Expression expression, double scale = 1.0);

  /// Through the points (times[i], values[i]), times strictly increasing, at least one point.
  /// A linear table has piecewise constant rate (at a corner that of the interval to the right) and
  /// zero acceleration; the spline is the natural cubic one. Outside the range, evaluation throws
  /// NumericalError, or the law is held at the first and last value with zero derivatives. A single
  /// point is a constant.
  /// @param where in the model file, for messages
  /// @throws InputError if times do not increase, sizes differ, or a number is not finite
  static TimeLaw table(std::vector<double> times, std::vector<double> values,
                       Interpolation interpolation,
                       Extrapolation extrapolation = Extrapolation::refuse,
                       SourceLocation where = {});

  /// ∫₀ᵗ rate(s) ds: the angle of a drive given by its speed. Exact for constants, else by
  /// quadrature (RunningIntegral); the rate is that law itself and the acceleration its rate.
  static TimeLaw integral(const TimeLaw& rate);

  /// Returns f(t) in SI units.
  /// @throws NumericalError naming the expression, its place, t and the value if f(t) is no number;
  ///         naming the table and its range if t lies outside
  double value(double t) const;
  /// df/dt
  double rate(double t) const;
  /// d²f/dt²
  double acceleration(double t) const;

  /// True if the law is constant.
  bool is_constant() const;

  /// Times at which the rate jumps: the corners of linear tables.
  /// Expressions are not searched.
  std::vector<double> corners() const;

  /// Range of a table that refuses times outside it; empty if the law is defined at all times.
  std::optional<TimeRange> range() const;

  /// Description for messages: the expression, "a table", or the number.
  std::string text() const;

 private:
  explicit TimeLaw(std::shared_ptr<const Body> body) : body_(std::move(body)) {}

  std::shared_ptr<const Body> body_;  // null: the constant
  double constant_ = 0;
};

}  // namespace buckens::base
