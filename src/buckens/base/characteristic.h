// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/expression.h"
#include "buckens/base/time_law.h"

namespace buckens::base {

/// The force of a spring and damper by displacement x and rate v: a formula of both or a table of
/// the displacement.
///
/// Copies share what they are made of. Evaluation is const and may run in several threads at once.
class Characteristic {
 public:
  /// Zero everywhere.
  Characteristic() = default;
  /// @param expression in two variables: displacement and rate. @param scale SI value of its unit
  static Characteristic formula(Expression expression, double scale);
  /// @param table force over displacement in place of time
  static Characteristic table(TimeLaw table);

  /// f(x, v). @throws NumericalError outside of a table, or where the formula has no value
  double force(double x, double v) const;
  /// ∫ f(s, 0) ds from 0 to x: the energy stored.
  double energy(double x) const;
  /// ∂f/∂x and ∂f/∂v by differences, good for the tangent of an iteration.
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
