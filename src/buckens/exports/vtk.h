// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "buckens/run_store/run_snapshot.h"

namespace buckens::exports {

/// Writes a run for ParaView: `<directory>/<name>_0000.vtu` and so on, one file per instant with
/// all bodies, and `<directory>/<name>.pvd`, which lists them with their times.
///
/// Points are deformed, in the world. A node has one point for each material that meets there,
/// because stresses may jump. Point data: `displacement` since the undeformed shape, rotated into
/// world axes, and the fields recorded at nodes; cell data: `body` (number in the order of the
/// model), `von_mises` and the fields recorded at elements. Values that were not recorded are NaN.
/// Rigid bodies are one vertex at their origin.
/// @return number of instants
/// @throws IoError
std::size_t export_vtk(const run_store::RunReader& run, const run_store::InstantChoice& choice,
                       const std::filesystem::path& directory, const std::string& name);

}  // namespace buckens::exports
