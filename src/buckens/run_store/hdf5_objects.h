// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

// Groups and data sets of files that anybody may have made or damaged. Our files contain plain
// objects with their values in the file itself; everything else is refused before it is followed:
// links to other places and files, values kept in other files, filters that HDF5 would load as
// plug-ins, values that do not fit into the file. Every function throws IoError with the file, the
// path, what is wrong and what to do.

/// What a path leads to.
enum class Hdf5Kind { missing, group, dataset, other };

/// Follows hard links only.
Hdf5Kind kind_of_object(const Hdf5File& file, const std::string& path);
bool has_object(const Hdf5File& file, const std::string& path);

/// Names of everything right below a group, in alphabetical order.
std::vector<std::string> list_objects(const Hdf5File& file, const std::string& path);

/// The kinds of values in our files.
enum class Hdf5Values { integers, numbers, texts };

/// A data set whose form has been checked.
struct Hdf5Dataset {
  Hdf5Handle handle;
  std::vector<hsize_t> extents;  ///< none: a single value
  std::size_t row_size = 1;      ///< values along all extents but the first
};

/// Opens a data set for reading.
/// @param values required kind of values
/// @param rows maximum number of rows wanted; all by default
Hdf5Dataset open_dataset(const Hdf5File& file, const std::string& path, Hdf5Values values,
                         hsize_t rows = static_cast<hsize_t>(-1));

/// Refuses a type of values other than the wanted one.
void check_type(const Hdf5File& file, const std::string& path, hid_t type, Hdf5Values values);

/// Extents of a space. @throws IoError if it has none, or an extent beyond the range of int
std::vector<hsize_t> extents_of(const Hdf5File& file, const std::string& path, hid_t space);

/// Number of values in extents, from extent number `first` on.
/// @throws IoError if a file of `file`'s size cannot contain as many values of `bytes` each
/// @param packing how many times smaller the values may be in the file
std::size_t count_values(const Hdf5File& file, const std::string& path,
                         const std::vector<hsize_t>& extents, std::size_t first, std::size_t bytes,
                         std::size_t packing);

/// @throws IoError "<file>: <path> <what>; …": not one of our files, or damaged
[[noreturn]] void refuse(const Hdf5File& file, const std::string& path, const std::string& what);

}  // namespace buckens::run_store
