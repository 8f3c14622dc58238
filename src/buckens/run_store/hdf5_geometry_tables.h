// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/results/geometry.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

// Thousands of rigid bodies and joints as tables. HDF5 takes a quarter of a millisecond to read
// what a group of its own says about a body, and two kilobytes to keep it.
//
//     /geometry/tables
//         body_names, joint_names, joint_types           texts
//         marker_counts [bodies], marker_names           of one body after the other
//         marker_positions [M×3], marker_orientations [M×4]
//         joint_sides [joints×4]                         body and marker of both sides, −1: none
//         joint_axes [joints×3], joint_positions [joints×6]

/// @pre all bodies are rigid
/// @throws IoError
void write_geometry_tables(const Hdf5File& file, const results::Geometry& geometry);

/// Reads bodies and joints if they stand in tables.
/// @return whether they do
/// @throws IoError
bool read_geometry_tables(const Hdf5File& file, results::Geometry& geometry);

}  // namespace buckens::run_store
