// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "buckens/base/dimension.h"
#include "buckens/base/expression.h"
#include "buckens/base/time_law.h"

namespace buckens::base {

/// A number given by a law of time, or by a formula of time and signals of the model.
struct SignalLaw {
  /// Maximum number of signals in one formula.
  static constexpr std::size_t kMostSignals = 8;

  SignalLaw() = default;
  /// A law of time, which is accepted wherever a formula of signals is.
  SignalLaw(TimeLaw of_time) : law(std::move(of_time)) {}  // NOLINT(google-explicit-constructor)
  /// A constant.
  SignalLaw(double number)  // NOLINT(google-explicit-constructor)
      : law(TimeLaw::constant(number)) {}
  /// The value of one signal. @param place its index among all signals
  static SignalLaw of(std::string signal, int place);

  TimeLaw law;                        ///< without signals
  std::optional<Expression> formula;  ///< in t and `names`, in this order
  double scale = 1;                   ///< SI value of the formula's unit
  std::vector<std::string> names;     ///< of the signals in the formula
  std::vector<int> places;            ///< of these among all signals
  /// Dimension of the unit as written, if the field accepts any.
  std::optional<Dimension> unit;

  bool uses_signals() const { return formula.has_value(); }
  bool uses(const std::string& signal) const;
  bool is_constant() const { return !formula && law.is_constant(); }
  bool is_number(double value) const { return is_constant() && law.value(0.0) == value; }
  /// Its value, if it is constant.
  std::optional<double> number() const {
    return is_constant() ? std::optional(law.value(0.0)) : std::nullopt;
  }

  /// @param signals t and the values of all signals; unused by a law of time
  /// @throws NumericalError naming the formula and its variables where it has no value
  double value(double t, std::span<const double> signals) const;
  /// Rate of a law of time; 0 for a formula of signals, whose rate is not known.
  double rate(double t) const { return formula ? 0.0 : law.rate(t); }
};

}  // namespace buckens::base
