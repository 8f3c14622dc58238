// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>

#include "buckens/linalg/grid_plugin.h"

namespace buckens::linalg {

/// Why there is no multigrid solver, and what to do; empty if there is one. Loads the plug-in.
std::string missing_grid_solver();

/// The plug-in with the multigrid solver (CMake option BUCKENS_PETSC), loaded on first use. It is
/// looked for in the file that the environment variable BUCKENS_GRID_PLUGIN names, else beside the
/// program or library that holds this code, in ../lib and in ../lib/buckens.
/// @throws IoError with missing_grid_solver()
const BuckensGridPlugin& grid_solver();

/// To be held while the plug-in works: the libraries behind it know one thread.
std::mutex& turn_of_grid_solver();

}  // namespace buckens::linalg
