// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/run_store/run_reader.h"

namespace buckens::run_store {

/// One number over the records of a run.
struct RunCurve {
  std::string name;  ///< "tip.x"
  std::string unit;  ///< SI
  std::vector<double> values;
};

/// The curves denoted by a name: a sensor (`tip`: all its components), one component (`tip.x`), its
/// length (`tip.norm`, vectors only), or the path of any recorded channel with few numbers
/// (`energies/kinetic`, `joints/pin/force.x`).
/// @throws InputError with the nearest names if there is nothing of this name
std::vector<RunCurve> find_curves(const RunReader& run, const std::string& name);

/// Names of all sensors and their components.
std::vector<std::string> sensor_names(const RunReader& run);

}  // namespace buckens::run_store
