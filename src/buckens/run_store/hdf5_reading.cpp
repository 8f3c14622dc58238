// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_reading.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/utf8.h"

namespace buckens::run_store {

namespace {

std::string named(const std::string& path, const std::string& attribute) {
  return path + " (attribute " + attribute + ")";
}

/// An attribute whose form has been checked; no valid handle where it is missing.
struct OpenAttribute {
  Hdf5Handle handle;
  Hdf5Handle space;
  std::size_t count = 0;
};

OpenAttribute open_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                             Hdf5Values values) {
  const std::string place = named(path, name);
  const std::string what = "read " + place;
  if (kind_of_object(file, path) == Hdf5Kind::missing) refuse(file, path, "is missing");
  const htri_t exists = H5Aexists_by_name(file.id(), path.c_str(), name.c_str(), H5P_DEFAULT);
  if (file.check(exists, what) == 0) return {};
  const hid_t id = H5Aopen_by_name(file.id(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  OpenAttribute out;
  out.handle = Hdf5Handle(file.check(id, what), H5Aclose);
  const Hdf5Handle type(file.check(H5Aget_type(id), what), H5Tclose);
  check_type(file, place, type.get(), values);
  out.space = Hdf5Handle(file.check(H5Aget_space(id), what), H5Sclose);
  const std::vector<hsize_t> extents = extents_of(file, place, out.space.get());
  out.count = count_values(file, place, extents, 0, H5Tget_size(type.get()), 1);
  return out;
}

template <typename Number>
std::vector<Number> attribute_numbers(const Hdf5File& file, const std::string& path,
                                      const std::string& name, Hdf5Values kind, hid_t type) {
  const Hdf5Quiet quiet;
  const OpenAttribute attribute = open_attribute(file, path, name, kind);
  std::vector<Number> values(attribute.count);
  if (!values.empty()) {
    file.check(H5Aread(attribute.handle.get(), type, values.data()), "read " + named(path, name));
  }
  return values;
}

template <typename Number>
std::vector<Number> all_values(const Hdf5File& file, const std::string& path,
                               const Hdf5Dataset& dataset, hid_t type) {
  std::vector<Number> values(dataset.row_size);
  if (!dataset.extents.empty()) values.resize(dataset.extents[0] * dataset.row_size);
  if (!values.empty()) {
    file.check(H5Dread(dataset.handle.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
               "read " + path);
  }
  return values;
}

template <typename Number>
std::vector<Number> dataset_numbers(const Hdf5File& file, const std::string& path,
                                    std::size_t columns, Hdf5Values kind, hid_t type) {
  const Hdf5Quiet quiet;
  const Hdf5Dataset dataset = open_dataset(file, path, kind);
  const std::size_t rank = columns == 1 ? 1 : 2;
  if (dataset.extents.size() != rank || (rank == 2 && dataset.extents[1] != columns)) {
    refuse(file, path,
           fmt::format("has the extents [{}] and should have {}", fmt::join(dataset.extents, " x "),
                       rank == 1 ? "one" : fmt::format("[any x {}]", columns)));
  }
  return all_values<Number>(file, path, dataset, type);
}

/// Texts as HDF5 hands them out, given back to it at the end.
class RawTexts {
 public:
  RawTexts(std::size_t count, hid_t space)
      : type_(H5Tcopy(H5T_C_S1), H5Tclose), space_(space), texts_(count) {
    H5Tset_size(type_.get(), H5T_VARIABLE);
    H5Tset_cset(type_.get(), H5T_CSET_UTF8);
  }
  ~RawTexts() {
    if (!texts_.empty()) H5Dvlen_reclaim(type_.get(), space_, H5P_DEFAULT, texts_.data());
  }
  RawTexts(const RawTexts&) = delete;
  RawTexts& operator=(const RawTexts&) = delete;

  bool empty() const { return texts_.empty(); }
  hid_t type() const { return type_.get(); }
  void* data() { return texts_.data(); }

  std::vector<std::string> copies() const {
    std::vector<std::string> out;
    for (const char* text : texts_) out.emplace_back(text != nullptr ? text : "");
    return out;
  }

 private:
  Hdf5Handle type_;
  hid_t space_;
  std::vector<char*> texts_;
};

/// Texts as the file gives them, or as another process has noted them.
template <typename Read>
std::vector<std::string> texts_at(const Hdf5File& file, const std::string& place,
                                  const Read& read) {
  Hdf5Texts* texts = file.texts();
  Hdf5Texts::Entry found;
  if (texts != nullptr && texts->is_complete()) {
    const Hdf5Texts::Entry* known = texts->find(place);
    if (known == nullptr) refuse(file, place, "has changed while it was read");
    found = *known;
  } else {
    try {
      found.texts = read();
    } catch (const IoError& error) {
      found.error = error.what();
    }
    if (texts != nullptr) texts->note(place, found);
  }
  if (!found.error.empty()) throw IoError(found.error);
  for (const std::string& text : found.texts) {
    if (!base::is_utf8(text)) refuse(file, place, "holds text that is not UTF-8");
  }
  return std::move(found.texts);
}

}  // namespace

std::vector<int> read_ints(const Hdf5File& file, const std::string& path,
                           const std::string& attribute) {
  return attribute_numbers<int>(file, path, attribute, Hdf5Values::integers, H5T_NATIVE_INT);
}

std::vector<double> read_doubles(const Hdf5File& file, const std::string& path,
                                 const std::string& attribute) {
  return attribute_numbers<double>(file, path, attribute, Hdf5Values::numbers, H5T_NATIVE_DOUBLE);
}

std::vector<std::string> read_strings(const Hdf5File& file, const std::string& path,
                                      const std::string& attribute) {
  const std::string place = named(path, attribute);
  return texts_at(file, place, [&] {
    const Hdf5Quiet quiet;
    const OpenAttribute opened = open_attribute(file, path, attribute, Hdf5Values::texts);
    if (opened.count == 0) return std::vector<std::string>();
    RawTexts raw(opened.count, opened.space.get());
    file.check(H5Aread(opened.handle.get(), raw.type(), raw.data()), "read " + place);
    return raw.copies();
  });
}

std::string read_string(const Hdf5File& file, const std::string& path,
                        const std::string& attribute) {
  const std::vector<std::string> values = read_strings(file, path, attribute);
  return values.empty() ? "" : values.front();
}

std::vector<double> read_double_dataset(const Hdf5File& file, const std::string& path,
                                        std::size_t columns) {
  return dataset_numbers<double>(file, path, columns, Hdf5Values::numbers, H5T_NATIVE_DOUBLE);
}

std::vector<int> read_int_dataset(const Hdf5File& file, const std::string& path,
                                  std::size_t columns) {
  return dataset_numbers<int>(file, path, columns, Hdf5Values::integers, H5T_NATIVE_INT);
}

std::vector<std::string> read_string_dataset(const Hdf5File& file, const std::string& path) {
  return texts_at(file, path, [&] {
    const Hdf5Quiet quiet;
    const Hdf5Dataset dataset = open_dataset(file, path, Hdf5Values::texts);
    if (dataset.extents.size() != 1) refuse(file, path, "is not a list of texts");
    if (dataset.extents[0] == 0) return std::vector<std::string>();
    const Hdf5Handle space(file.check(H5Dget_space(dataset.handle.get()), "read " + path),
                           H5Sclose);
    RawTexts raw(dataset.extents[0], space.get());
    file.check(H5Dread(dataset.handle.get(), raw.type(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()),
               "read " + path);
    return raw.copies();
  });
}

std::vector<double> read_any_double_dataset(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  const Hdf5Dataset dataset = open_dataset(file, path, Hdf5Values::numbers);
  return all_values<double>(file, path, dataset, H5T_NATIVE_DOUBLE);
}

namespace {

/// Reads a block of a data set.
void read_block(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& path,
                const std::vector<hsize_t>& start, const std::vector<hsize_t>& block,
                double* values) {
  const Hdf5Quiet quiet;
  const std::string what = "read " + path;
  const Hdf5Handle from(file.check(H5Dget_space(dataset.handle.get()), what), H5Sclose);
  const hid_t selected =
      H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  file.check(selected, what);
  const Hdf5Handle to(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                      H5Sclose);
  file.check(
      H5Dread(dataset.handle.get(), H5T_NATIVE_DOUBLE, to.get(), from.get(), H5P_DEFAULT, values),
      what);
}

}  // namespace

void read_rows(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& path,
               std::size_t first, std::size_t count, double* values) {
  std::vector<hsize_t> block = dataset.extents;
  std::vector<hsize_t> start(block.size(), 0);
  start.at(0) = first;
  block.at(0) = count;
  read_block(file, dataset, path, start, block, values);
}

void read_rows(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& path,
               std::size_t first, std::size_t count, const Hdf5Range& entries, double* values) {
  std::vector<hsize_t> block = dataset.extents;
  std::vector<hsize_t> start(block.size(), 0);
  start.at(0) = first;
  block.at(0) = count;
  start.at(1) = entries.first;
  block.at(1) = entries.count;
  read_block(file, dataset, path, start, block, values);
}

}  // namespace buckens::run_store
