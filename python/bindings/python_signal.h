// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings/python_function.h"

#include "buckens/model/build/function_signals.h"

namespace buckens::python {

/// A Python function that computes the value of a signal.
struct PythonSignal {
  std::string name;
  std::vector<std::string> inputs;  ///< signals whose values it takes
  /// f(t, values of the inputs …): numbers; returns a number.
  pybind11::function function;
};

/// The signal as the library evaluates it, from a thread without Python's lock.
/// @param pending stores exceptions of the function, see call_within_step()
model::SignalFunction signal_function(const PythonSignal& signal,
                                      std::shared_ptr<PendingException> pending);

}  // namespace buckens::python
