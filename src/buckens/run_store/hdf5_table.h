// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "buckens/results/channel.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

/// A growing table of results.h5: the instants and one data set per channel, [records × shape].
class Hdf5Table {
 public:
  Hdf5Table() = default;
  /// Creates the empty data sets with their attributes `unit`, `description` and `components`.
  /// Must happen before Hdf5File::start_swmr.
  /// @param time path of the instants
  /// @param type of the values in the file; the instants have double precision
  /// @throws IoError
  Hdf5Table(const Hdf5File& file, const results::RecordLayout& layout,
            const std::string& time = "time", hid_t type = H5T_IEEE_F64LE);

  /// Appends records and makes them visible to readers.
  ///
  /// The instants are extended last: a reader finds at least as many rows in every channel at any
  /// moment, also after a crash.
  /// @param values  consecutive records, layout.num_values() each
  /// @throws IoError; the file must then be abandoned
  void append(Hdf5File& file, std::span<const double> times, std::span<const double> values);

  /// Closes the data sets until open_again(): HDF5 makes a file readable while it grows in a time
  /// that increases with the square of what is open.
  void close_for_now();
  /// @throws IoError
  void open_again(const Hdf5File& file);

  /// Closes the data sets.
  void close();
  hsize_t num_records() const { return num_records_; }

 private:
  struct Column {
    Hdf5Handle dataset;
    std::string path;
    hsize_t chunk_values = 0;
    std::vector<hsize_t> shape;
    std::size_t offset = 0;
    std::size_t size = 1;
  };

  static Column create_column(const Hdf5File& file, const results::Channel& channel, hid_t type);
  void append_to(const Hdf5File& file, const Column& column, hsize_t count, const double* values);

  Column time_;
  std::vector<Column> columns_;
  std::size_t row_size_ = 0;
  hsize_t num_records_ = 0;
  std::vector<double> block_;  // one channel's part of the records
};

}  // namespace buckens::run_store
