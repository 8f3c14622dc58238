// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <hdf5.h>

#include "buckens/run_store/hdf5_file.h"

namespace buckens::fuzz {

/// Changes an HDF5 file as a text says, line by line. What cannot be done is left out.
///
///     data PATH TYPE EXTENT...   another data set in place of an object; TYPE as type_called()
///     put PATH INDEX VALUE       one value of a data set
///     attr PATH NAME TYPE EXTENT...
///     soft PATH TARGET           a link of that kind in place of an object
///     ext PATH TARGET
///     hard PATH TARGET
///     drop PATH
///     byte OFFSET VALUE          of the file itself, as all the changes above left it
///     cut SIZE
class ResultEdits {
 public:
  explicit ResultEdits(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && edits_.size() < 16;) {
      std::istringstream words(line);
      edits_.emplace_back(std::istream_iterator<std::string>(words),
                          std::istream_iterator<std::string>());
    }
  }

  void apply(const std::filesystem::path& path) const {
    const run_store::Hdf5Quiet quiet;
    {
      const run_store::Hdf5Handle settings(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_libver_bounds(settings.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
      const run_store::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, settings.get()),
                                       H5Fclose);
      for (const Words& words : edits_) {
        if (file.is_valid() && words.size() >= 2) change(file.get(), words);
      }
    }
    for (const Words& words : edits_) {
      if (words.size() >= 2) change_bytes(path, words);
    }
  }

 private:
  using Words = std::vector<std::string>;

  static std::uint64_t number(const Words& words, std::size_t k) {
    std::uint64_t out = 0;
    if (k < words.size()) {
      std::from_chars(words[k].data(), words[k].data() + words[k].size(), out);
    }
    return out;
  }

  static run_store::Hdf5Handle type_called(const std::string& name) {
    const auto copy = [](hid_t type) { return run_store::Hdf5Handle(H5Tcopy(type), H5Tclose); };
    if (name == "f4") return copy(H5T_IEEE_F32LE);
    if (name == "i4") return copy(H5T_STD_I32LE);
    if (name == "i8") return copy(H5T_STD_I64BE);
    if (name == "s3" || name == "text") {
      run_store::Hdf5Handle out = copy(H5T_C_S1);
      H5Tset_size(out.get(), name == "text" ? H5T_VARIABLE : 3);
      return out;
    }
    return copy(H5T_IEEE_F64LE);
  }

  /// The extents from the word number `k` on.
  static run_store::Hdf5Handle space(const Words& words, std::size_t k,
                                     std::vector<hsize_t>& extents) {
    for (; k < words.size() && extents.size() < 6; ++k) extents.push_back(number(words, k));
    if (extents.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
    return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
  }

  static void change(hid_t file, const Words& words) {
    const std::string& what = words[0];
    const char* path = words[1].c_str();
    const char* target = words.size() > 2 ? words[2].c_str() : "/time";
    if (what == "put") put(file, words);
    if (what == "attr" && words.size() > 3) put_attribute(file, words);
    const bool is_other = what == "soft" || what == "ext" || what == "hard" || what == "data";
    if (is_other || what == "drop") H5Ldelete(file, path, H5P_DEFAULT);
    if (what == "soft") H5Lcreate_soft(target, file, path, H5P_DEFAULT, H5P_DEFAULT);
    if (what == "ext") H5Lcreate_external("other.h5", target, file, path, H5P_DEFAULT, H5P_DEFAULT);
    if (what == "hard") H5Lcreate_hard(file, target, file, path, H5P_DEFAULT, H5P_DEFAULT);
    if (what == "data" && words.size() > 2) put_data(file, words);
  }

  static void put_data(hid_t file, const Words& words) {
    std::vector<hsize_t> extents;
    const run_store::Hdf5Handle form = space(words, 3, extents);
    const run_store::Hdf5Handle settings(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    double count = 1;
    for (const hsize_t extent : extents) count *= static_cast<double>(extent);
    if (count > 4096) {  // claimed, never written
      std::vector<hsize_t> chunk = extents;
      for (hsize_t& extent : chunk) extent = std::clamp<hsize_t>(extent, 1, 4);
      H5Pset_chunk(settings.get(), static_cast<int>(chunk.size()), chunk.data());
    }
    const run_store::Hdf5Handle type = type_called(words[2]);
    const run_store::Hdf5Handle dataset(H5Dcreate2(file, words[1].c_str(), type.get(), form.get(),
                                                   H5P_DEFAULT, settings.get(), H5P_DEFAULT),
                                        H5Dclose);
  }

  static void put_attribute(hid_t file, const Words& words) {
    const char* path = words[1].c_str();
    const char* name = words[2].c_str();
    std::vector<hsize_t> extents;
    const run_store::Hdf5Handle form = space(words, 4, extents);
    const run_store::Hdf5Handle type = type_called(words[3]);
    H5Adelete_by_name(file, path, name, H5P_DEFAULT);
    const run_store::Hdf5Handle attribute(
        H5Acreate_by_name(file, path, name, type.get(), form.get(), H5P_DEFAULT, H5P_DEFAULT,
                          H5P_DEFAULT),
        H5Aclose);
  }

  static void put(hid_t file, const Words& words) {
    const run_store::Hdf5Handle dataset(H5Dopen2(file, words[1].c_str(), H5P_DEFAULT), H5Dclose);
    const run_store::Hdf5Handle form(H5Dget_space(dataset.get()), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(form.get());
    const run_store::Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
    const bool is_number =
        H5Tget_class(type.get()) == H5T_INTEGER || H5Tget_class(type.get()) == H5T_FLOAT;
    if (!is_number || count <= 0 || count > 4096 || words.size() < 4) return;
    std::vector<double> values(static_cast<std::size_t>(count));
    H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    double value = std::nan("");
    std::from_chars(words[3].data(), words[3].data() + words[3].size(), value);
    values[number(words, 2) % values.size()] = value;
    H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

  static void change_bytes(const std::filesystem::path& path, const Words& words) {
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    if (ignored || size == 0) return;
    const std::uint64_t at = number(words, 1) % size;
    if (words[0] == "cut") std::filesystem::resize_file(path, at, ignored);
    if (words[0] != "byte") return;
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(number(words, 2)));
  }

  std::vector<Words> edits_;
};

}  // namespace buckens::fuzz
