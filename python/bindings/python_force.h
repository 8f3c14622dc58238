// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

#include "bindings/python_function.h"

#include "buckens/model/spec/model_description.h"

namespace buckens::python {

/// A Python function that computes the force on a marker.
struct PythonForce {
  std::string name;    ///< of the load, in results and messages
  std::string marker;  ///< "rod/end"
  /// f(t, x, v): time [s], position [m] and velocity [m/s] of the marker, world axes, arrays of 3;
  /// returns three numbers [N], world axes.
  pybind11::function function;
};

/// The force as the library evaluates it, from a thread without Python's lock.
/// @param pending stores exceptions of the function, see call_within_step()
/// @param origin of positions in the model, known once it is built
model::OwnForce own_force(const PythonForce& force, std::shared_ptr<PendingException> pending,
                          std::shared_ptr<const Eigen::Vector3d> origin);

}  // namespace buckens::python
