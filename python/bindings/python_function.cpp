// SPDX-License-Identifier: Apache-2.0
#include "bindings/python_function.h"

namespace py = pybind11;

namespace buckens::python {

void PendingException::keep(py::error_already_set&& raised) {
  if (!error) error.emplace(std::move(raised));
}

void PendingException::deliver() {
  if (!error) return;
  py::error_already_set raised = std::move(*error);
  error.reset();
  throw raised;
}

SharedFunction::~SharedFunction() {
  const py::gil_scoped_acquire lock;
  function.release().dec_ref();
}

}  // namespace buckens::python
