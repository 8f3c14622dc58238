// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/results/geometry.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

/// Writes shapes of contact and cables, each into one table: there may be thousands of shapes.
void write_shapes(const Hdf5File& file, const results::Geometry& geometry);
void write_cables(const Hdf5File& file, const results::Geometry& geometry);

/// Reads them, nothing from runs that have none. @param geometry with its bodies
/// @throws IoError if they are damaged
void read_shapes(const Hdf5File& file, results::Geometry& geometry);
void read_cables(const Hdf5File& file, results::Geometry& geometry);

}  // namespace buckens::run_store
