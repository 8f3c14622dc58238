// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "buckens/base/errors.h"

namespace buckens::python {

/// The exception of a Python function called within a step, stored until the step has ended and
/// Python receives it. Accessed with Python's lock held.
struct PendingException {
  std::optional<pybind11::error_already_set> error;

  /// Stores the first exception.
  void keep(pybind11::error_already_set&& raised);
  /// Raises it, if there is one.
  void deliver();
};

/// Holds a Python function that may be destroyed by a thread without Python's lock.
struct SharedFunction {
  pybind11::function function;
  explicit SharedFunction(pybind11::function given) : function(std::move(given)) {}
  SharedFunction(const SharedFunction&) = delete;
  SharedFunction& operator=(const SharedFunction&) = delete;
  ~SharedFunction();
};

/// Calls a Python function from a thread without Python's lock. Its exception is stored and causes
/// a NumericalError, which ends the step and leaves the state unchanged.
/// @param call with the lock held; may throw pybind11::type_error about the returned value
/// @param what for the message: "the force on \"rod/end\""
template <class Call>
auto call_within_step(PendingException& pending, const std::string& what, Call&& call) {
  const pybind11::gil_scoped_acquire lock;
  try {
    if (!pending.error) return call();
  } catch (pybind11::error_already_set& raised) {
    pending.keep(std::move(raised));
  } catch (const pybind11::type_error& error) {
    error.set_error();
    pending.keep(pybind11::error_already_set());
  }
  throw NumericalError("the function that gives " + what + " raised " + pending.error->what());
}

}  // namespace buckens::python
