// SPDX-License-Identifier: Apache-2.0
#include "bindings/exceptions.h"

#include <exception>
#include <filesystem>

#include <pybind11/pybind11.h>

#include "buckens/base/errors.h"

namespace py = pybind11;

namespace buckens::python {

namespace {

void raise(const char* name, const char* text, const SourceLocation& where) {
  try {
    const py::object type = py::module_::import("buckens.errors").attr(name);
    const py::object error = type(text);
    if (!where.empty()) error.attr("file") = where.file;
    if (where.line > 0) {
      error.attr("line") = where.line;
      error.attr("column") = where.column;
    }
    PyErr_SetObject(type.ptr(), error.ptr());
  } catch (py::error_already_set& failure) {
    failure.restore();
  }
}

}  // namespace

void translate_exceptions() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise("InputError", error.what(), error.where());
    } catch (const ModelError& error) {
      raise("ModelError", error.what(), error.where());
    } catch (const NumericalError& error) {
      raise("NumericalError", error.what(), error.where());
    } catch (const IoError& error) {
      raise("IoError", error.what(), error.where());
    } catch (const std::filesystem::filesystem_error& error) {
      raise("IoError", error.what(), {});
    }
  });
}

}  // namespace buckens::python
