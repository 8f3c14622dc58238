// SPDX-License-Identifier: Apache-2.0
#include "bindings/python_force.h"

#include <utility>

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "buckens/loads/differenced_force.h"
#include "buckens/model/builder.h"

namespace py = pybind11;

namespace buckens::python {

namespace {

py::array_t<double> array_of(const Eigen::Vector3d& vector) {
  return py::array_t<double>(3, vector.data());
}

/// @throws py::type_error saying what the function returned instead
Eigen::Vector3d three_numbers(const py::object& value, const std::string& marker) {
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
