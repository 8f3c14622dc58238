// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/results/channel.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

/// Data sets of results.h5 that exist once and are overwritten during a run. Until first written
/// they contain NaN.
class Hdf5Extremes {
 public:
  Hdf5Extremes() = default;
  /// Creates the data sets. Must happen before Hdf5File::start_swmr. @throws IoError
  Hdf5Extremes(const Hdf5File& file, const results::RecordLayout& layout);

  /// Replaces all values and passes them to the system.
  /// @param values  layout.num_values() numbers
  /// @throws IoError; the file must then be abandoned
  void write(Hdf5File& file, const std::vector<double>& values);
  /// Closes the data sets.
  void close();

 private:
  struct Column {
    Hdf5Handle dataset;
    std::string path;
    std::size_t offset = 0;
  };
  std::vector<Column> columns_;
};

}  // namespace buckens::run_store
