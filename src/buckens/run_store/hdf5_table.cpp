// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_table.h"

#include <algorithm>
#include <utility>

#include "buckens/results/stored_size.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace {

/// A small chunk cache: only the last chunk is ever needed again, and none that one row fills,
/// which is written from where it is.
Hdf5Handle table_settings(hsize_t chunk_values, std::size_t row_values) {
  Hdf5Handle settings(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  const std::size_t chunks = chunk_values > row_values ? 2 : 0;
  H5Pset_chunk_cache(settings.get(), 7, chunks * sizeof(double) * chunk_values, 1.0);
  return settings;
}

}  // namespace

Hdf5Table::Hdf5Table(const Hdf5File& file, const results::RecordLayout& layout,
                     const std::string& time, hid_t type)
    : row_size_(layout.num_values()) {
  time_ = create_column(file,
                        {.path = time,
                         .unit = "s",
                         .shape = {},
                         .description = "instants of the records",
                         .components = {}},
                        H5T_IEEE_F64LE);
  for (std::size_t i = 0; i < layout.channels().size(); ++i) {
    columns_.push_back(create_column(file, layout.channel(i), type));
    columns_.back().offset = layout.offset(i);
  }
}

Hdf5Table::Column Hdf5Table::create_column(const Hdf5File& file, const results::Channel& channel,
                                           hid_t type) {
  Column column;
  column.path = "/" + channel.path;
  column.size = channel.size();
  for (const int extent : channel.shape) column.shape.push_back(static_cast<hsize_t>(extent));

  const Hdf5Quiet quiet;
  std::vector<hsize_t> now{0}, most{H5S_UNLIMITED}, chunk{results::chunk_rows(column.size)};
  for (std::vector<hsize_t>* extents : {&now, &most, &chunk}) {
    extents->insert(extents->end(), column.shape.begin(), column.shape.end());
  }
  const auto rank = static_cast<int>(now.size());
  const Hdf5Handle space(H5Screate_simple(rank, now.data(), most.data()), H5Sclose);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(creation.get(), rank, chunk.data());
  const Hdf5Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link.get(), 1);
  column.chunk_values = chunk[0] * column.size;
  const hid_t id =
      H5Dcreate2(file.id(), column.path.c_str(), type, space.get(), link.get(), creation.get(),
                 table_settings(column.chunk_values, column.size).get());
  column.dataset = Hdf5Handle(file.check(id, "create " + column.path), H5Dclose);

  write_attribute(file, column.path, "unit", channel.unit);
  write_attribute(file, column.path, "description", channel.description);
  if (!channel.components.empty()) {
    write_attribute(file, column.path, "components", channel.components);
  }
  return column;
}

void Hdf5Table::append_to(const Hdf5File& file, const Column& column, hsize_t count,
                          const double* values) {
  const std::string what = "write " + column.path;
  std::vector<hsize_t> extents{num_records_ + count}, start{num_records_}, block{count};
  for (std::vector<hsize_t>* list : {&extents, &block}) {
    list->insert(list->end(), column.shape.begin(), column.shape.end());
  }
  start.resize(extents.size(), 0);
  const hid_t dataset = column.dataset.get();
  file.check(H5Dset_extent(dataset, extents.data()), what);
  const Hdf5Handle target(file.check(H5Dget_space(dataset), what), H5Sclose);
  H5Sselect_hyperslab(target.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  const Hdf5Handle source(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                          H5Sclose);
  file.check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, source.get(), target.get(), H5P_DEFAULT, values),
             what);
}

void Hdf5Table::append(Hdf5File& file, std::span<const double> times,
                       std::span<const double> values) {
  if (times.empty()) return;
  const Hdf5Quiet quiet;
  for (const Column& column : columns_) {
    if (times.size() == 1) {
      append_to(file, column, 1, values.data() + column.offset);
      continue;
    }
    block_.resize(times.size() * column.size);
    for (std::size_t row = 0; row < times.size(); ++row) {
      std::copy_n(values.data() + row * row_size_ + column.offset, column.size,
                  block_.data() + row * column.size);
    }
    append_to(file, column, times.size(), block_.data());
  }
  file.flush();
  append_to(file, time_, times.size(), times.data());
  file.check(H5Dflush(time_.dataset.get()), "write " + time_.path);
  file.check_written();
  num_records_ += times.size();
}

void Hdf5Table::close_for_now() {
  const Hdf5Quiet quiet;
  for (Column& column : columns_) column.dataset.reset();
  time_.dataset.reset();
}

void Hdf5Table::open_again(const Hdf5File& file) {
  const Hdf5Quiet quiet;
  const auto open = [&file](Column& column) {
    const hid_t id = H5Dopen2(file.id(), column.path.c_str(),
                              table_settings(column.chunk_values, column.size).get());
    column.dataset = Hdf5Handle(file.check(id, "open " + column.path), H5Dclose);
  };
  if (!time_.path.empty()) open(time_);
  for (Column& column : columns_) open(column);
}

void Hdf5Table::close() {
  const Hdf5Quiet quiet;
  columns_.clear();
  time_.dataset.reset();
}

}  // namespace buckens::run_store
