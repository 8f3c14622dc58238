// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_values.h"

#include <utility>

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
  file.check(H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), what);
}

std::size_t count(hid_t space) {
  return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
}

/// Attribute, or no valid handle where it is missing.
Hdf5Handle open_attribute(const Hdf5File& file, const std::string& path, const std::string& name) {
  const htri_t exists = H5Aexists_by_name(file.id(), path.c_str(), name.c_str(), H5P_DEFAULT);
  if (file.check(exists, "read " + place(path, name)) == 0) return {};
  const hid_t id = H5Aopen_by_name(file.id(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  return {file.check(id, "read " + place(path, name)), H5Aclose};
}

template <typename Number>
std::vector<Number> attribute_numbers(const Hdf5File& file, const std::string& path,
                                      const std::string& name, hid_t type) {
  const Hdf5Quiet quiet;
  const Hdf5Handle attribute = open_attribute(file, path, name);
  if (!attribute.is_valid()) return {};
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  std::vector<Number> values(count(space.get()));
  if (!values.empty()) {
    file.check(H5Aread(attribute.get(), type, values.data()), "read " + place(path, name));
  }
  return values;
}

template <typename Number>
std::vector<Number> dataset_numbers(const Hdf5File& file, const std::string& path, hid_t type) {
  const Hdf5Quiet quiet;
  const std::string what = "read " + path;
  const Hdf5Handle dataset(file.check(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), what),
                           H5Dclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  std::vector<Number> values(count(space.get()));
  if (!values.empty()) {
    file.check(H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
  }
  return values;
}

/// Copies the strings and gives HDF5's memory back.
std::vector<std::string> take_strings(std::vector<char*>& raw, hid_t type, hid_t space) {
  std::vector<std::string> values;
  for (const char* text : raw) values.emplace_back(text != nullptr ? text : "");
  if (!raw.empty()) H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
  return values;
}

}  // namespace

void create_group(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  const hid_t id =
      H5Gcreate2(file.id(), path.c_str(), create_parents().get(), H5P_DEFAULT, H5P_DEFAULT);
  const Hdf5Handle group(file.check(id, "create the group " + path), H5Gclose);
}

bool has_object(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  // Each part of the path must be asked for by itself.
  for (std::size_t at = path.find('/', 1);; at = path.find('/', at + 1)) {
    const std::string part = path.substr(0, at);
    if (part != "/" && H5Lexists(file.id(), part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (at == path.npos) return true;
  }
}

std::vector<std::string> list_objects(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  const std::string what = "list " + path;
  const Hdf5Handle group(file.check(H5Gopen2(file.id(), path.c_str(), H5P_DEFAULT), what),
                         H5Gclose);
  H5G_info_t group_info;
  file.check(H5Gget_info(group.get(), &group_info), what);
  std::vector<std::string> names;
  for (hsize_t i = 0; i < group_info.nlinks; ++i) {
    const auto get = [&](char* text, std::size_t size) {
      return H5Lget_name_by_idx(group.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, text, size,
                                H5P_DEFAULT);
    };
    const auto length = static_cast<std::size_t>(file.check(get(nullptr, 0), what));
    std::string name(length, '\0');
    file.check(get(name.data(), length + 1), what);
    names.push_back(std::move(name));
  }
  return names;
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

std::vector<int> read_ints(const Hdf5File& file, const std::string& path,
                           const std::string& attribute) {
  return attribute_numbers<int>(file, path, attribute, H5T_NATIVE_INT);
}

std::vector<double> read_doubles(const Hdf5File& file, const std::string& path,
                                 const std::string& attribute) {
  return attribute_numbers<double>(file, path, attribute, H5T_NATIVE_DOUBLE);
}

std::vector<std::string> read_strings(const Hdf5File& file, const std::string& path,
                                      const std::string& attribute) {
  const Hdf5Quiet quiet;
  const Hdf5Handle opened = open_attribute(file, path, attribute);
  if (!opened.is_valid()) return {};
  const Hdf5Handle space(H5Aget_space(opened.get()), H5Sclose);
  const Hdf5Handle type = text_type();
  std::vector<char*> raw(count(space.get()));
  if (!raw.empty()) {
    file.check(H5Aread(opened.get(), type.get(), raw.data()), "read " + place(path, attribute));
  }
  return take_strings(raw, type.get(), space.get());
}

std::string read_string(const Hdf5File& file, const std::string& path,
                        const std::string& attribute) {
  const std::vector<std::string> values = read_strings(file, path, attribute);
  return values.empty() ? "" : values.front();
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

std::vector<double> read_double_dataset(const Hdf5File& file, const std::string& path) {
  return dataset_numbers<double>(file, path, H5T_NATIVE_DOUBLE);
}

std::vector<int> read_int_dataset(const Hdf5File& file, const std::string& path) {
  return dataset_numbers<int>(file, path, H5T_NATIVE_INT);
}

std::vector<std::string> read_string_dataset(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  const std::string what = "read " + path;
  const Hdf5Handle dataset(file.check(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), what),
                           H5Dclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const Hdf5Handle type = text_type();
  std::vector<char*> raw(count(space.get()));
  if (!raw.empty()) {
    file.check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), what);
  }
  return take_strings(raw, type.get(), space.get());
}

std::vector<hsize_t> extents_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank < 0 ? 0 : rank));
  if (!extents.empty()) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return extents;
}

}  // namespace buckens::run_store
