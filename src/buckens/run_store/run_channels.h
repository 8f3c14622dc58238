// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/results/channel.h"
#include "buckens/results/geometry.h"
#include "buckens/run_store/hdf5_reading.h"

namespace buckens::run_store {

/// The channels below a group of results.h5, in alphabetical order of their paths.
/// @param group "/" for the records, "/fields" for the fields
/// @param rows that each channel must have
/// @throws IoError for anything that is not a channel of ours: too many levels, loops, other types
/// of values, extents that do not fit into the file, conflicting names
results::RecordLayout read_layout(const Hdf5File& file, const std::string& group, hsize_t rows);

/// Opens a channel of read_layout() to read some of its rows. @throws IoError
Hdf5Dataset open_channel(const Hdf5File& file, const results::Channel& channel);

/// Refuses channels of bodies that do not match the body's mesh: their readers rely on it.
/// @throws IoError
void check_channels(const Hdf5File& file, const results::Geometry& geometry,
                    const results::RecordLayout& records, const results::RecordLayout& fields);

}  // namespace buckens::run_store
