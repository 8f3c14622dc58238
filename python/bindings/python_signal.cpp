// SPDX-License-Identifier: Apache-2.0
#include "bindings/python_signal.h"

#include <utility>

#include <fmt/format.h>

namespace py = pybind11;

namespace buckens::python {

namespace {

/// @throws py::type_error saying what the function returned instead
double number(const py::object& value, const std::string& signal) {
  const double out = PyFloat_AsDouble(value.ptr());
  if (out == -1.0 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw py::type_error(fmt::format("the value of signal \"{}\" must be a number, found {}",
                                     signal, py::repr(value).cast<std::string>()));
  }
  return out;
}

}  // namespace

model::SignalFunction signal_function(const PythonSignal& signal,
                                      std::shared_ptr<PendingException> pending) {
  const auto shared = std::make_shared<const SharedFunction>(signal.function);
  auto law = [shared, pending = std::move(pending), name = signal.name](
                 double t, std::span<const double> values) {
    return call_within_step(*pending, fmt::format("the signal \"{}\"", name), [&] {
      py::tuple arguments(values.size() + 1);
      arguments[0] = t;
      for (std::size_t k = 0; k < values.size(); ++k) arguments[k + 1] = values[k];
      return number(shared->function(*arguments), name);
    });
  };
  return {signal.name, signal.inputs, std::move(law)};
}

}  // namespace buckens::python
