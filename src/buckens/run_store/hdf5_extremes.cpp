// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_extremes.h"

#include <limits>

#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

Hdf5Extremes::Hdf5Extremes(const Hdf5File& file, const results::RecordLayout& layout) {
  for (std::size_t i = 0; i < layout.channels().size(); ++i) {
    const results::Channel& channel = layout.channel(i);
    const std::string path = "/" + channel.path;
    std::vector<hsize_t> shape;
    for (const int extent : channel.shape) shape.push_back(static_cast<hsize_t>(extent));
    const std::vector<double> empty(channel.size(), std::numeric_limits<double>::quiet_NaN());
    write_dataset(file, path, shape, empty);
    write_attribute(file, path, "unit", channel.unit);
    write_attribute(file, path, "description", channel.description);
    const Hdf5Quiet quiet;
    const hid_t id = H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT);
    columns_.push_back({{file.check(id, "open " + path), H5Dclose}, path, layout.offset(i)});
  }
}

void Hdf5Extremes::write(Hdf5File& file, const std::vector<double>& values) {
  const Hdf5Quiet quiet;
  for (const Column& column : columns_) {
    const herr_t done = H5Dwrite(column.dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL,
                                 H5P_DEFAULT, values.data() + column.offset);
    file.check(done, "write " + column.path);
    file.check(H5Dflush(column.dataset.get()), "write " + column.path);
  }
  file.check_written();
}

void Hdf5Extremes::close() {
  const Hdf5Quiet quiet;
  columns_.clear();
}

}  // namespace buckens::run_store
