// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/results/geometry.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

/// Writes the cross-sections of a body's line elements below its group; nothing if it has none.
void write_sections(const Hdf5File& file, const std::string& path,
                    const results::GeometryBody& body);

/// Reads them back; a file without them leaves the body unchanged.
/// @param body whose line elements are known
/// @throws IoError if the lists are inconsistent
void read_sections(const Hdf5File& file, const std::string& path, results::GeometryBody& body);

}  // namespace buckens::run_store
