// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "buckens/run_store/hdf5_objects.h"

namespace buckens::run_store {

// Values of files that anybody may have made or damaged. `path` names a group or data set; every
// function throws IoError with the file and the path for values of another kind or form, and for
// text that is not UTF-8.

/// Attributes of the group or data set at `path`. Empty lists if the attribute is missing.
std::vector<std::string> read_strings(const Hdf5File& file, const std::string& path,
                                      const std::string& attribute);
std::vector<int> read_ints(const Hdf5File& file, const std::string& path,
                           const std::string& attribute);
std::vector<double> read_doubles(const Hdf5File& file, const std::string& path,
                                 const std::string& attribute);
/// First entry of a text attribute, empty if it is missing.
std::string read_string(const Hdf5File& file, const std::string& path,
                        const std::string& attribute);

/// Whole data sets, values in row-major order.
/// @param columns the required extents are [any]; with more than one column, [any × columns]
std::vector<double> read_double_dataset(const Hdf5File& file, const std::string& path,
                                        std::size_t columns = 1);
std::vector<int> read_int_dataset(const Hdf5File& file, const std::string& path,
                                  std::size_t columns = 1);
std::vector<std::string> read_string_dataset(const Hdf5File& file, const std::string& path);

/// The same with any extents.
std::vector<double> read_any_double_dataset(const Hdf5File& file, const std::string& path);

/// Reads rows of a data set.
/// @param values room for count × row_size values
void read_rows(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& path,
               std::size_t first, std::size_t count, double* values);

/// Entries along the second extent, of all rows that are read.
struct Hdf5Range {
  std::size_t first = 0, count = 0;
};
/// The same for some entries of each row.
/// @pre the data set has a second extent
/// @param values room for count × entries.count × the values of an entry
void read_rows(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& path,
               std::size_t first, std::size_t count, const Hdf5Range& entries, double* values);

}  // namespace buckens::run_store
