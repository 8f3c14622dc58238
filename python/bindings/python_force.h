// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <pybind11/pybind11.h>

#include "buckens/model/spec/model_description.h"

namespace buckens::python {

/// The exception of a Python function that was called within a step, until the step has ended and
/// Python gets it back. Accessed with Python's lock held.
struct PendingException {
  std::optional<pybind11::error_already_set> error;

  /// Keeps the first one.
  void keep(pybind11::error_already_set&& raised);
  /// Raises it, if there is one.
  void deliver();
};

/// A function of Python that gives the force on a marker.
struct PythonForce {
  std::string name;    ///< of the load, in results and messages
  std::string marker;  ///< "rod/end"
  /// f(t, x, v): time [s], position [m] and velocity [m/s] of the marker, world axes, arrays of 3;
  /// returns three numbers [N], world axes.
  pybind11::function function;
};

/// The force as the library evaluates it, from a thread without Python's lock.
///
/// What the function raises becomes a NumericalError, which ends the step and leaves the state as
/// it was; `pending` keeps the original.
/// @param origin of positions in the model, known once it is built
model::OwnForce own_force(const PythonForce& force, std::shared_ptr<PendingException> pending,
                          std::shared_ptr<const Eigen::Vector3d> origin);

}  // namespace buckens::python
