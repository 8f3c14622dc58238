// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/expression.h"
#include "buckens/base/time_law.h"

namespace buckens::base {

/// Force of a spring and damper as a function of displacement x and rate v: a formula in both, or
/// a table over the displacement.
///
/// Copies share their data. Evaluation is const and may run in several threads at once.
class Characteristic {
 public:
  /// Zero everywhere.
  Characteristic() = default;
  /// @param expression in two variables: displacement and rate. @param scale SI value of its unit
  static Characteristic formula(Expression expression, double scale);
  /// @param table force over displacement, instead of time
  static Characteristic table(TimeLaw table);

  /// f(x, v). @throws NumericalError outside a table, or where the formula has no value
  double force(double x, double v) const;
  /// ∫ f(s, 0) ds from 0 to x: the stored energy.
  double energy(double x) const;
  /// ∂f/∂x and ∂f/∂v by finite differences, accurate enough for the tangent of an iteration.
  struct Slopes {
    double stiffness = 0, damping = 0;
  };
  Slopes slopes(double x, double v) const;

  /// For messages: the expression, or "a table".
  std::string text() const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace buckens::base
