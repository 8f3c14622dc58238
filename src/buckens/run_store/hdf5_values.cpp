// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace {

/// Strings of any length in UTF-8: h5py gives them as str.
Hdf5Handle text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle create_parents() {
  Hdf5Handle settings(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(settings.get(), 1);
  return settings;
}

std::vector<const char*> pointers(const std::vector<std::string>& values) {
  std::vector<const char*> all;
  for (const std::string& value : values) all.push_back(value.c_str());
  return all;
}

Hdf5Handle make_space(const std::vector<hsize_t>& shape) {
  const auto rank = static_cast<int>(shape.size());
  return {rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape.data(), nullptr),
          H5Sclose};
}

/// Texts are converted in room that HDF5 fills with zeros for each data set: 1 MiB, unless told
/// otherwise.
Hdf5Handle little_room() {
  constexpr std::size_t kRoom = 1 << 14;
  Hdf5Handle settings(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_buffer(settings.get(), kRoom, nullptr, nullptr);
  return settings;
}

std::string place(const std::string& path, const std::string& attribute) {
  return attribute.empty() ? path : path + " (attribute " + attribute + ")";
}

void put_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                   hid_t file_type, hid_t memory_type, const std::vector<hsize_t>& shape,
                   const void* values) {
  const Hdf5Quiet quiet;
  const std::string what = "write " + place(path, name);
  const Hdf5Handle space = make_space(shape);
  const hid_t id = H5Acreate_by_name(file.id(), path.c_str(), name.c_str(), file_type, space.get(),
                                     H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const Hdf5Handle attribute(file.check(id, what), H5Aclose);
  if (values != nullptr) file.check(H5Awrite(attribute.get(), memory_type, values), what);
}

void put_dataset(const Hdf5File& file, const std::string& path, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& shape, const void* values) {
  const Hdf5Quiet quiet;
  const std::string what = "write " + path;
  const Hdf5Handle space = make_space(shape);
  const hid_t id = H5Dcreate2(file.id(), path.c_str(), file_type, space.get(),
                              create_parents().get(), H5P_DEFAULT, H5P_DEFAULT);
  const Hdf5Handle dataset(file.check(id, what), H5Dclose);
  if (H5Sget_simple_extent_npoints(space.get()) == 0) return;
  const Hdf5Handle transfer = little_room();
  file.check(H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, transfer.get(), values), what);
}

}  // namespace

void create_group(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  const hid_t id =
      H5Gcreate2(file.id(), path.c_str(), create_parents().get(), H5P_DEFAULT, H5P_DEFAULT);
  const Hdf5Handle group(file.check(id, "create the group " + path), H5Gclose);
}

void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     const std::string& value) {
  const Hdf5Handle type = text_type();
  const char* text = value.c_str();
  put_attribute(file, path, name, type.get(), type.get(), {}, &text);
}

void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     const std::vector<std::string>& values) {
  const Hdf5Handle type = text_type();
  const std::vector<const char*> texts = pointers(values);
  put_attribute(file, path, name, type.get(), type.get(), {texts.size()},
                texts.empty() ? nullptr : texts.data());
}

void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     std::span<const int> values) {
  put_attribute(file, path, name, H5T_STD_I32LE, H5T_NATIVE_INT, {values.size()},
                values.empty() ? nullptr : values.data());
}

void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     std::span<const double> values) {
  put_attribute(file, path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()},
                values.empty() ? nullptr : values.data());
}

void write_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                     int value) {
  put_attribute(file, path, name, H5T_STD_I32LE, H5T_NATIVE_INT, {}, &value);
}

void write_dataset(const Hdf5File& file, const std::string& path, const std::vector<hsize_t>& shape,
                   std::span<const double> values) {
  put_dataset(file, path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, values.data());
}

void write_dataset(const Hdf5File& file, const std::string& path, const std::vector<hsize_t>& shape,
                   std::span<const int> values) {
  put_dataset(file, path, H5T_STD_I32LE, H5T_NATIVE_INT, shape, values.data());
}

void write_dataset(const Hdf5File& file, const std::string& path,
                   const std::vector<std::string>& values) {
  const Hdf5Handle type = text_type();
  put_dataset(file, path, type.get(), type.get(), {values.size()}, pointers(values).data());
}

}  // namespace buckens::run_store
