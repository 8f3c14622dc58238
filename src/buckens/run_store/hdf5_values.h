// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

// Values of fixed extent in an HDF5 file. `path` names a group or data set; every function throws
// IoError with the file and the path.

/// Creates a group; its parents must exist or are created.
void create_group(const Hdf5File& file, const std::string& path);
bool has_object(const Hdf5File& file, const std::string& path);
/// Names of the groups and data sets right below a group, in alphabetical order.
std::vector<std::string> list_objects(const Hdf5File& file, const std::string& path);

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

/// Empty lists where the attribute is missing.
std::vector<std::string> read_strings(const Hdf5File& file, const std::string& path,
                                      const std::string& attribute);
std::vector<int> read_ints(const Hdf5File& file, const std::string& path,
                           const std::string& attribute);
std::vector<double> read_doubles(const Hdf5File& file, const std::string& path,
                                 const std::string& attribute);
/// First entry of a text attribute, empty where it is missing.
std::string read_string(const Hdf5File& file, const std::string& path,
                        const std::string& attribute);

/// Data sets of fixed extent, values in row-major order; parents are created.
void write_dataset(const Hdf5File& file, const std::string& path, const std::vector<hsize_t>& shape,
                   std::span<const double> values);
void write_dataset(const Hdf5File& file, const std::string& path, const std::vector<hsize_t>& shape,
                   std::span<const int> values);
void write_dataset(const Hdf5File& file, const std::string& path,
                   const std::vector<std::string>& values);
std::vector<double> read_double_dataset(const Hdf5File& file, const std::string& path);
std::vector<int> read_int_dataset(const Hdf5File& file, const std::string& path);
std::vector<std::string> read_string_dataset(const Hdf5File& file, const std::string& path);

/// Extents of an open data set or attribute space.
std::vector<hsize_t> extents_of(hid_t space);

}  // namespace buckens::run_store
