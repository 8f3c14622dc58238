// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"
#include "buckens/model/function_signal.h"

namespace buckens::model {

/// A function in code that computes the value of a signal; a model file cannot express it.
struct SignalFunction {
  std::string name;                 ///< of a signal with a `setting` or a formula (`value`)
  std::vector<std::string> inputs;  ///< signals whose values it takes
  FunctionSignal::Law law;
};

/// Assigns functions to signals, in place of their settings and formulas.
///
/// Functions are evaluated within the steps, with the motion of the last iterate, so that a
/// controller written as a function has no delay. Theory: docs/theory/24-control.md §3.
/// @throws InputError, ModelError naming signals that do not exist or follow from the motion,
///         events that would set them, and signals of an algebraic loop
void give_functions(const std::vector<SignalFunction>& functions, BuiltModel& built);

}  // namespace buckens::model
