// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "buckens/run_store/run_snapshot.h"

namespace buckens::exports {

/// Writes the contents of results.h5 as tables for spreadsheets:
///
///     sensors.csv             a line per record; as complete as results.h5 is
///     <body>_nodes.csv        a line per chosen instant and place: t, node, undeformed x, y, z in
///                             the body frame, then all fields at nodes
///     <body>_elements.csv     the same for solid elements, numbered from 1
///     <body>_nodes_extremes.csv (and _elements_…)   the largest von Mises stresses and when
///     <body>_loads.csv        a line per chosen instant: force and torque at every place
///
/// Empty cells are values that do not exist. Numbers of fields have 9 digits, their full
/// precision.
/// @return names of the files
/// @throws IoError
std::vector<std::string> export_csv(const run_store::RunReader& run,
                                    const run_store::InstantChoice& choice,
                                    const std::filesystem::path& directory);

}  // namespace buckens::exports
