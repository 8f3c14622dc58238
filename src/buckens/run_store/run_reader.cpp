// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_reader.h"

#include <algorithm>
#include <numeric>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/hdf5_geometry.h"
#include "buckens/run_store/hdf5_values.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::run_store {

namespace {

/// Extents of a data set.
std::vector<hsize_t> shape_of(const Hdf5File& file, const Hdf5Handle& dataset) {
  const Hdf5Handle space(file.check(H5Dget_space(dataset.get()), "read a data set"), H5Sclose);
  return extents_of(space.get());
}

Hdf5Handle open_dataset(const Hdf5File& file, const std::string& path) {
  const hid_t id = H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT);
  return {file.check(id, "read " + path), H5Dclose};
}

/// Reads `count` rows from row `first` on into `values`.
void read_rows(const Hdf5File& file, const Hdf5Handle& dataset, const std::string& path,
               std::size_t first, std::size_t count, double* values) {
  const std::string what = "read " + path;
  const Hdf5Handle from(file.check(H5Dget_space(dataset.get()), what), H5Sclose);
  std::vector<hsize_t> block = extents_of(from.get());
  std::vector<hsize_t> start(block.size(), 0);
  start[0] = first;
  block[0] = count;
  const hid_t selected =
      H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  file.check(selected, what);
  const Hdf5Handle to(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                      H5Sclose);
  file.check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, to.get(), from.get(), H5P_DEFAULT, values),
             what);
}

}  // namespace

RunReader::RunReader(const std::filesystem::path& directory) {
  const std::filesystem::path summary = directory / kSummaryName;
  std::error_code ignored;
  if (!std::filesystem::exists(summary, ignored)) {
    throw IoError(
        fmt::format("{}: not a run directory: it holds no {}. Give the directory that "
                    "`buckens run` has written (-o).",
                    directory.string(), kSummaryName));
  }
  summary_text_ = files::read_text_file(summary);
  status_ = status_in(summary_text_, summary.string());
  if (!std::filesystem::exists(directory / kResultsName, ignored)) {
    throw IoError(
        fmt::format("{}: the run has no results: {} is missing. It is still starting, or "
                    "ended before its first record; see {}.",
                    directory.string(), kResultsName, kLogName));
  }
  file_ = Hdf5File::open_for_reading(directory / kResultsName);
  title_ = read_string(file_, "/", "title");
  version_ = read_string(file_, "/", "version");
  geometry_ = read_geometry(file_);
  read_channels("/", layout_);
  // Fields first: each of their instants is then one of the records.
  if (has_object(file_, "/fields/time")) {
    read_channels("/fields/", field_layout_);
    field_times_ = read_times("/fields/time");
  }
  times_ = read_times("/time");
}

void RunReader::read_channels(const std::string& group, results::RecordLayout& layout) {
  for (const std::string& name : list_objects(file_, group)) {
    const std::string path = group + name;
    if (path == "/geometry" || path == "/time" || path == "/fields" || path == "/extremes" ||
        path == "/fields/time") {
      continue;
    }
    const Hdf5Quiet quiet;
    const Hdf5Handle object(
        file_.check(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), "read " + path), H5Oclose);
    if (H5Iget_type(object.get()) == H5I_GROUP) {
      read_channels(path + "/", layout);
    } else if (H5Iget_type(object.get()) == H5I_DATASET) {
      const std::vector<hsize_t> extents = shape_of(file_, object);
      if (extents.empty()) continue;
      results::Channel channel;
      channel.path = path.substr(1);
      channel.unit = read_string(file_, path, "unit");
      channel.description = read_string(file_, path, "description");
      channel.components = read_strings(file_, path, "components");
      for (std::size_t i = 1; i < extents.size(); ++i) {
        channel.shape.push_back(static_cast<int>(extents[i]));
      }
      layout.add(std::move(channel));
    }
  }
}

std::vector<double> RunReader::read_times(const std::string& path) const {
  const Hdf5Quiet quiet;
  const Hdf5Handle dataset = open_dataset(file_, path);
  const std::vector<hsize_t> extents = shape_of(file_, dataset);
  std::vector<double> times(extents.empty() ? 0 : extents[0]);
  if (!times.empty()) read_rows(file_, dataset, path, 0, times.size(), times.data());
  return times;
}

std::vector<double> RunReader::read(std::string_view path) const {
  std::vector<std::size_t> all(num_records());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return read(path, all);
}

std::vector<double> RunReader::read(std::string_view path,
                                    std::span<const std::size_t> records) const {
  return read_rows_of(layout_, path, records);
}

std::vector<double> RunReader::read_fields(std::string_view path,
                                           std::span<const std::size_t> rows) const {
  return read_rows_of(field_layout_, path, rows);
}

std::vector<double> RunReader::read_fixed(std::string_view path) const {
  const std::string place = fmt::format("/{}", path);
  return has_object(file_, place) ? read_double_dataset(file_, place) : std::vector<double>();
}

std::size_t RunReader::record_of_field(std::size_t row) const {
  const auto at = std::lower_bound(times_.begin(), times_.end(), field_times_.at(row));
  if (at == times_.end()) {
    throw IoError(fmt::format("{}: fields at t = {} s belong to no record.", file_.path().string(),
                              field_times_[row]));
  }
  return static_cast<std::size_t>(at - times_.begin());
}

std::vector<double> RunReader::read_rows_of(const results::RecordLayout& layout,
                                            std::string_view path,
                                            std::span<const std::size_t> records) const {
  const int index = layout.find(path);
  if (index < 0) {
    throw IoError(fmt::format("{}: holds no \"{}\".", file_.path().string(), path));
  }
  const Hdf5Quiet quiet;
  const std::string place = fmt::format("/{}", path);
  const Hdf5Handle dataset = open_dataset(file_, place);
  const std::size_t size = layout.channel(static_cast<std::size_t>(index)).size();
  std::vector<double> values(records.size() * size);
  // Neighbouring records are read together.
  for (std::size_t i = 0; i < records.size();) {
    std::size_t count = 1;
    while (i + count < records.size() && records[i + count] == records[i] + count) ++count;
    read_rows(file_, dataset, place, records[i], count, values.data() + i * size);
    i += count;
  }
  return values;
}

}  // namespace buckens::run_store
