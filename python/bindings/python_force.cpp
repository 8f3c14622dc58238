// SPDX-License-Identifier: Apache-2.0
#include "bindings/python_force.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "buckens/loads/differenced_force.h"
#include "buckens/model/builder.h"

namespace py = pybind11;

namespace buckens::python {

namespace {

/// Without the further copy that a constructor from data makes.
py::array_t<double> array_of(const Eigen::Vector3d& vector) {
  py::array_t<double> out(3);
  std::copy_n(vector.data(), 3, out.mutable_data());
  return out;
}

/// Three floats in a tuple or list, as most functions return them: an array in between would take a
/// third of the time of a call.
std::optional<Eigen::Vector3d> three_floats(PyObject* value) {
  if (!PyTuple_CheckExact(value) && !PyList_CheckExact(value)) return std::nullopt;
  if (PySequence_Fast_GET_SIZE(value) != 3) return std::nullopt;
  Eigen::Vector3d out;
  for (int k = 0; k < 3; ++k) {
    PyObject* const item = PySequence_Fast_GET_ITEM(value, k);
    if (!PyFloat_Check(item)) return std::nullopt;
    out[k] = PyFloat_AS_DOUBLE(item);
  }
  return out;
}

/// @throws py::type_error saying what the function returned instead
Eigen::Vector3d three_numbers(const py::object& value, const std::string& marker) {
  if (const auto floats = three_floats(value.ptr())) return *floats;
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array || array.ndim() != 1 || array.shape(0) != 3) {
    PyErr_Clear();
    throw py::type_error(fmt::format("the force on \"{}\" must be three numbers [N], found {}",
                                     marker, py::repr(value).cast<std::string>()));
  }
  const double* values = array.data();
  return {values[0], values[1], values[2]};
}

}  // namespace

model::OwnForce own_force(const PythonForce& force, std::shared_ptr<PendingException> pending,
                          std::shared_ptr<const Eigen::Vector3d> origin) {
  const auto shared = std::make_shared<const SharedFunction>(force.function);
  auto law = [shared, pending = std::move(pending), origin = std::move(origin),
              marker = force.marker](double t,
                                     const spatial::MarkerMotion& motion) -> Eigen::Vector3d {
    return call_within_step(*pending, fmt::format("the force on \"{}\"", marker), [&] {
      return three_numbers(shared->function(t, array_of(motion.p + *origin), array_of(motion.v)),
                           marker);
    });
  };
  model::OwnForce out;
  out.name = force.name;
  out.first = model::ModelBuilder::marker(force.marker);
  out.second = model::ModelBuilder::marker("ground");
  out.element = std::make_shared<loads::DifferencedForce>(std::move(law));
  return out;
}

}  // namespace buckens::python
