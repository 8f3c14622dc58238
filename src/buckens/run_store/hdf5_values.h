// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

// Writes values of fixed extent into an HDF5 file. `path` names a group or data set; every function
// throws IoError with the file and the path.

/// Creates a group; its parents must exist or are created.
void create_group(const Hdf5File& file, const std::string& path);

/// Attributes of the group or data set at `path`; lists become one-dimensional attributes.
void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     const std::string& value);
void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     const std::vector<std::string>& values);
void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     std::span<const int> values);
void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     std::span<const double> values);
/// A single number instead of a list.
void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     int value);

/// Data sets of fixed extent, values in row-major order; parents are created.
void write_dataset(const Hdf5File& file, const std::string& path, const std::vector<hsize_t>& shape,
                   std::span<const double> values);
void write_dataset(const Hdf5File& file, const std::string& path, const std::vector<hsize_t>& shape,
                   std::span<const int> values);
void write_dataset(const Hdf5File& file, const std::string& path,
                   const std::vector<std::string>& values);

}  // namespace buckens::run_store
