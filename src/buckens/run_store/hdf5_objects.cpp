// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_objects.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/utf8.h"

namespace buckens::run_store {

namespace {

/// Deflate makes nothing smaller than by this factor.
constexpr std::size_t kStrongestPacking = 1032;
/// Numbers of a row that no record fills yet: far more than any model has per byte of its geometry.
constexpr std::size_t kEmptyPacking = 64;

/// Refuses links that lead elsewhere. @return false if the link is missing
bool is_plain_link(const Hdf5File& file, const std::string& part) {
  if (H5Lexists(file.id(), part.c_str(), H5P_DEFAULT) <= 0) return false;
  H5L_info_t link;
  file.check(H5Lget_info(file.id(), part.c_str(), &link, H5P_DEFAULT), "read " + part);
  if (link.type != H5L_TYPE_HARD) refuse(file, part, "is a link to another place or file");
  return true;
}

/// @return false if something along the path is missing
bool is_plain_path(const Hdf5File& file, const std::string& path) {
  // HDF5 follows the links before the last part without asking: each is looked at by itself.
  for (std::size_t at = path.find('/', 1);; at = path.find('/', at + 1)) {
    const std::string part = path.substr(0, at);
    if (part != "/" && !is_plain_link(file, part)) return false;
    if (at == path.npos) return true;
  }
}

/// Refuses values that lie elsewhere. @return how much smaller than plain the values may be
std::size_t check_storage(const Hdf5File& file, const std::string& path, hid_t dataset) {
  const std::string what = "read " + path;
  const Hdf5Handle settings(file.check(H5Dget_create_plist(dataset), what), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(settings.get());
  const bool is_known = layout == H5D_COMPACT || layout == H5D_CONTIGUOUS || layout == H5D_CHUNKED;
  if (!is_known || H5Pget_external_count(settings.get()) > 0) {
    refuse(file, path, "keeps its values in other data sets or files");
  }
  const int filters = H5Pget_nfilters(settings.get());
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0;
    std::size_t none = 0;
    const H5Z_filter_t filter = H5Pget_filter2(settings.get(), static_cast<unsigned>(k), &flags,
                                               &none, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32) {
      refuse(file, path, "is packed in a way that needs another program");
    }
  }
  return filters > 0 ? kStrongestPacking : 1;
}

struct Listing {
  std::vector<std::string> names;
  bool has_other_links = false;
};

/// Called by HDF5, through whose C code no exception may pass.
herr_t add_name(hid_t, const char* name, const H5L_info_t* link, void* argument) noexcept {
  auto& listing = *static_cast<Listing*>(argument);
  listing.has_other_links = link->type != H5L_TYPE_HARD;
  try {
    listing.names.emplace_back(name);
  } catch (...) {
    return -1;
  }
  return listing.has_other_links ? 1 : 0;
}

}  // namespace

void refuse(const Hdf5File& file, const std::string& path, const std::string& what) {
  throw IoError(fmt::format(
      "{}: {} {}; the file is damaged, or another program has made or changed it. Run the model "
      "again.",
      file.path().string(), path, what));
}

Hdf5Kind kind_of_object(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  if (!is_plain_path(file, path)) return Hdf5Kind::missing;
  const Hdf5Handle object(file.check(H5Oopen(file.id(), path.c_str(), H5P_DEFAULT), "read " + path),
                          H5Oclose);
  switch (H5Iget_type(object.get())) {
    case H5I_GROUP:
      return Hdf5Kind::group;
    case H5I_DATASET:
      return Hdf5Kind::dataset;
    default:
      return Hdf5Kind::other;
  }
}

bool has_object(const Hdf5File& file, const std::string& path) {
  return kind_of_object(file, path) != Hdf5Kind::missing;
}

std::vector<std::string> list_objects(const Hdf5File& file, const std::string& path) {
  const Hdf5Quiet quiet;
  if (kind_of_object(file, path) != Hdf5Kind::group) refuse(file, path, "is not a group");
  const std::string what = "list " + path;
  const Hdf5Handle group(file.check(H5Gopen2(file.id(), path.c_str(), H5P_DEFAULT), what),
                         H5Gclose);
  Listing listing;
  hsize_t at = 0;
  file.check(H5Literate(group.get(), H5_INDEX_NAME, H5_ITER_INC, &at, add_name, &listing), what);
  const std::string before = path == "/" ? path : path + '/';
  if (listing.has_other_links) {
    refuse(file, before + listing.names.back(), "is a link to another place or file");
  }
  for (const std::string& name : listing.names) {
    if (!base::is_utf8(name)) refuse(file, path, "holds a name that is not UTF-8 text");
  }
  return std::move(listing.names);
}

void check_type(const Hdf5File& file, const std::string& path, hid_t type, Hdf5Values values) {
  const H5T_class_t found = H5Tget_class(type);
  switch (values) {
    case Hdf5Values::integers:
      if (found != H5T_INTEGER) refuse(file, path, "does not hold integers");
      return;
    case Hdf5Values::numbers:
      if (found != H5T_FLOAT) refuse(file, path, "does not hold floating-point numbers");
      return;
    case Hdf5Values::texts:
      if (found != H5T_STRING || H5Tis_variable_str(type) <= 0) {
        refuse(file, path, "does not hold texts of any length");
      }
      return;
  }
}

std::vector<hsize_t> extents_of(const Hdf5File& file, const std::string& path, hid_t space) {
  const H5S_class_t kind = H5Sget_simple_extent_type(space);
  const int rank = H5Sget_simple_extent_ndims(space);
  if ((kind != H5S_SCALAR && kind != H5S_SIMPLE) || rank < 0) {
    refuse(file, path, "has no extents");
  }
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  if (rank > 0) {
    file.check(H5Sget_simple_extent_dims(space, extents.data(), nullptr), "read " + path);
  }
  for (const hsize_t extent : extents) {
    if (extent > static_cast<hsize_t>(std::numeric_limits<int>::max())) {
      refuse(file, path, fmt::format("claims an extent of {}", extent));
    }
  }
  return extents;
}

std::size_t count_values(const Hdf5File& file, const std::string& path,
                         const std::vector<hsize_t>& extents, std::size_t first, std::size_t bytes,
                         std::size_t packing) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(file.path(), ignored);
  const std::size_t most = ignored ? 0 : static_cast<std::size_t>(size) * packing / bytes;
  std::size_t count = 1;
  for (std::size_t i = first; i < extents.size(); ++i) {
    if (extents[i] == 0) return 0;
    if (count > most / extents[i]) {
      refuse(
          file, path,
          fmt::format("claims {} values, more than the file can hold", fmt::join(extents, " x ")));
    }
    count *= extents[i];
  }
  return count;
}

Hdf5Dataset open_dataset(const Hdf5File& file, const std::string& path, Hdf5Values values,
                         hsize_t rows) {
  const Hdf5Quiet quiet;
  if (kind_of_object(file, path) != Hdf5Kind::dataset) {
    refuse(file, path, "is missing or not a data set");
  }
  const std::string what = "read " + path;
  Hdf5Dataset out;
  out.handle =
      Hdf5Handle(file.check(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), what), H5Dclose);
  const Hdf5Handle type(file.check(H5Dget_type(out.handle.get()), what), H5Tclose);
  check_type(file, path, type.get(), values);
  const std::size_t packing = check_storage(file, path, out.handle.get());
  const Hdf5Handle space(file.check(H5Dget_space(out.handle.get()), what), H5Sclose);
  out.extents = extents_of(file, path, space.get());
  const std::size_t bytes = std::max<std::size_t>(H5Tget_size(type.get()), 1);
  out.row_size = count_values(file, path, out.extents, 1, bytes, packing * kEmptyPacking);
  std::vector<hsize_t> wanted = out.extents;
  if (!wanted.empty()) wanted[0] = std::min(wanted[0], rows);
  count_values(file, path, wanted, 0, bytes, packing);
  return out;
}

}  // namespace buckens::run_store
