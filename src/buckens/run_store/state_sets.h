// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

// Data sets of one dimension, of which saved states consist.

/// `id` if it is sound. @throws IoError "cannot <what>: <reason>"
inline hid_t sound(hid_t id, const char* what) {
  if (id < 0) throw IoError(fmt::format("cannot {}: {}", what, hdf5_reason()));
  return id;
}

inline hid_t type_of(double) { return H5T_IEEE_F64LE; }
inline hid_t type_of(float) { return H5T_IEEE_F32LE; }
inline hid_t type_of(std::int64_t) { return H5T_STD_I64LE; }
inline hid_t type_of(std::uint8_t) { return H5T_STD_U8LE; }

/// Where a list is in a data set, for H5Dwrite() and H5Dread().
struct PlaceInSet {
  PlaceInSet(hid_t set, hsize_t first, hsize_t count)
      : there(H5Dget_space(set), H5Sclose), here(H5Screate_simple(1, &count, nullptr), H5Sclose) {
    sound(H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr),
          "find a list");
  }

  Hdf5Handle there, here;
};

/// A data set that is there.
template <class Number>
class FoundSet {
 public:
  /// @param most entries that the file can hold at all
  /// @throws IoError for other types and shapes
  FoundSet(hid_t group, const char* name, std::size_t most)
      : set_(sound(H5Dopen2(group, name, H5P_DEFAULT), "find a data set"), H5Dclose) {
    const Hdf5Handle type(H5Dget_type(set_.get()), H5Tclose);
    const Hdf5Handle space(H5Dget_space(set_.get()), H5Sclose);
    if (H5Tequal(type.get(), type_of(Number{})) <= 0) {
      throw IoError("a data set has another type");
    }
    hsize_t extent = 0;
    if (H5Sget_simple_extent_ndims(space.get()) != 1 ||
        H5Sget_simple_extent_dims(space.get(), &extent, nullptr) != 1 || extent > most) {
      throw IoError("a data set has another shape");
    }
    size_ = extent;
  }

  std::size_t size() const { return size_; }
  /// HDF5 converts numbers to those of `values` on their way.
  template <class Numbers>
  void take(std::size_t first, Numbers& values) const {
    if (values.size() == 0) return;
    const PlaceInSet place(set_.get(), first, values.size());
    sound(H5Dread(set_.get(), type_of(*values.data()), place.here.get(), place.there.get(),
                  H5P_DEFAULT, values.data()),
          "read a data set");
  }
  std::vector<Number> all() const {
    std::vector<Number> values(size_);
    take(0, values);
    return values;
  }

 private:
  Hdf5Handle set_;
  std::size_t size_ = 0;
};

}  // namespace buckens::run_store
