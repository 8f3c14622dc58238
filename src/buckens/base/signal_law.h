// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "buckens/base/expression.h"
#include "buckens/base/time_law.h"

namespace buckens::base {

/// A number that varies with time by a law, or by a formula of time and signals of the model.
struct SignalLaw {
  /// Signals that one formula may name.
  static constexpr std::size_t kMostSignals = 8;

  SignalLaw() = default;
  /// A law of time, which takes the place of a formula of signals everywhere.
  SignalLaw(TimeLaw of_time) : law(std::move(of_time)) {}  // NOLINT(google-explicit-constructor)

  TimeLaw law;                        ///< without signals
  std::optional<Expression> formula;  ///< in t and `names`, in this order
  double scale = 1;                   ///< SI value of the formula's unit
  std::vector<std::string> names;     ///< of the signals in the formula
  std::vector<int> places;            ///< of these among all signals

  bool uses_signals() const { return formula.has_value(); }
  bool uses(const std::string& signal) const;
  bool is_constant() const { return !formula && law.is_constant(); }

  /// @param signals t and the values of all signals; unused by a law of time
  /// @throws NumericalError naming the formula and its variables where it has no value
  double value(double t, std::span<const double> signals) const;
  /// Of a law of time; formulas of signals have none that is known.
  double rate(double t) const { return formula ? 0.0 : law.rate(t); }
};

}  // namespace buckens::base
