// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/state_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/hdf5_file.h"
#include "buckens/run_store/run_files.h"

namespace buckens::run_store {

namespace {

constexpr std::string_view kMark = "\nbuckens state\n";
constexpr std::string_view kHdf5Mark = "\x89HDF";
constexpr std::size_t kIncrement = 1 << 16;  // by which a file in memory grows, filled with zeros

std::string trailer(std::string_view bytes) {
  std::string out = fmt::format("{}format {}\nbytes {}\nchecksum {:016x}\n", kMark, kStateFormat,
                                bytes.size(), base::checksum(bytes));
  out.insert(out.size() - 1, kStateTrailer - out.size(), ' ');
  return out;
}

hid_t sound(hid_t id, const char* what) {
  if (id < 0) throw IoError(fmt::format("cannot {}: {}", what, hdf5_reason()));
  return id;
}

Hdf5Handle settings_in_memory() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Images of newer formats have a checksum that their own writer has made wrong (HDF5 1.10).
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  sound(H5Pset_fapl_core(access.get(), kIncrement, 0), "keep a file in memory");
  return access;
}

hid_t type_of(double) { return H5T_IEEE_F64LE; }
hid_t type_of(std::int64_t) { return H5T_STD_I64LE; }
hid_t type_of(std::uint8_t) { return H5T_STD_U8LE; }

/// Without times of day: equal states are equal files.
Hdf5Handle without_times(hid_t kind) {
  Hdf5Handle settings(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(settings.get(), false);
  return settings;
}

template <class Number>
void put(hid_t group, const char* name, const std::vector<Number>& values) {
  const hsize_t extent = values.size();
  const Hdf5Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Hdf5Handle set(sound(H5Dcreate2(group, name, type_of(Number{}), space.get(), H5P_DEFAULT,
                                        without_times(H5P_DATASET_CREATE).get(), H5P_DEFAULT),
                             "write a data set"),
                       H5Dclose);
  if (values.empty()) return;
  sound(H5Dwrite(set.get(), type_of(Number{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "write a data set");
}

/// @param most entries that the file can hold at all
template <class Number>
std::vector<Number> take(hid_t group, const char* name, std::size_t most) {
  const Hdf5Handle set(sound(H5Dopen2(group, name, H5P_DEFAULT), "find a data set"), H5Dclose);
  const Hdf5Handle type(H5Dget_type(set.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.get()), H5Sclose);
  if (H5Tequal(type.get(), type_of(Number{})) <= 0) throw IoError("a data set has another type");
  hsize_t extent = 0;
  if (H5Sget_simple_extent_ndims(space.get()) != 1 ||
      H5Sget_simple_extent_dims(space.get(), &extent, nullptr) != 1 || extent > most) {
    throw IoError("a data set has another shape");
  }
  std::vector<Number> values(extent);
  if (values.empty()) return values;
  sound(H5Dread(set.get(), type_of(Number{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "read a data set");
  return values;
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

template <class Map>
void put_group(hid_t file, const char* name, const Map& map) {
  const Hdf5Handle group(
      sound(H5Gcreate2(file, name, H5P_DEFAULT, without_times(H5P_GROUP_CREATE).get(), H5P_DEFAULT),
            "write a group"),
      H5Gclose);
  std::string names;
  std::vector<std::int64_t> lengths;
  typename Map::mapped_type values;
  for (const auto& [path, list] : map) {
    names += path + '\n';
    lengths.push_back(static_cast<std::int64_t>(list.size()));
    values.insert(values.end(), list.begin(), list.end());
  }
  put(group.get(), "names", bytes_of(names));
  put(group.get(), "lengths", lengths);
  put(group.get(), "values", values);
}

template <class Map>
void take_group(hid_t file, const char* name, std::size_t size, Map& map) {
  using List = typename Map::mapped_type;
  const Hdf5Handle group(sound(H5Gopen2(file, name, H5P_DEFAULT), "find a group"), H5Gclose);
  const auto names = take<std::uint8_t>(group.get(), "names", size);
  const auto lengths = take<std::int64_t>(group.get(), "lengths", size / sizeof(std::int64_t));
  const List values = take<typename List::value_type>(group.get(), "values",
                                                      size / sizeof(typename List::value_type));
  std::size_t at = 0;
  auto letter = names.begin();
  for (const std::int64_t length : lengths) {
    std::string path;
    while (letter != names.end() && *letter != '\n') path += static_cast<char>(*letter++);
    const bool is_sound = letter != names.end() && length >= 0 &&
                          static_cast<std::uint64_t>(length) <= values.size() - at;
    if (!is_sound) throw IoError("names and lengths do not fit together");
    ++letter;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(at);
    map[path] = List(first, first + static_cast<std::ptrdiff_t>(length));
    at += static_cast<std::size_t>(length);
  }
  if (at != values.size() || letter != names.end()) throw IoError("values are left over");
}

/// Texts as bytes, each ended by zero.
std::map<std::string, std::vector<std::uint8_t>> packed(const base::SavedValues& state) {
  std::map<std::string, std::vector<std::uint8_t>> out;
  for (const auto& [path, texts] : state.texts) {
    std::vector<std::uint8_t>& bytes = out[path];
    for (const std::string& text : texts) {
      bytes.insert(bytes.end(), text.begin(), text.end());
      bytes.push_back(0);
    }
  }
  return out;
}

std::vector<std::string> unpacked(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::string> out;
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (byte != 0) {
      text += static_cast<char>(byte);
    } else {
      out.push_back(std::exchange(text, {}));
    }
  }
  return out;
}

/// What helps if a state is damaged. A checkpoint was written by its run, which ended.
std::string_view remedy(const std::string& name) {
  return std::filesystem::path(name).filename() == kCheckpointName
             ? "the run cannot be continued; run the model from the start, or from a state saved "
               "with --save-state"
             : "save it again";
}

/// The bytes before the trailer, once they have proved sound.
std::string_view checked(std::string_view bytes, const std::string& name) {
  const std::size_t size = bytes.size() - std::min(bytes.size(), kStateTrailer);
  const std::string_view content = bytes.substr(0, size);
  const std::string_view end = bytes.substr(size);
  if (!end.starts_with(kMark)) {
    throw IoError(fmt::format(
        "{}: {}; use a file that `buckens run --save-state` has written", name,
        bytes.starts_with(kHdf5Mark) ? "this is no saved state, or the end of the file is missing"
                                     : "this is no saved state"));
  }
  const std::string expected = trailer(content);
  if (end == expected) return content;
  const std::size_t first_line = expected.find('\n', kMark.size());
  if (end.substr(0, first_line) != std::string_view(expected).substr(0, first_line)) {
    throw IoError(
        fmt::format("{}: the saved state has another format than {}; use the version of "
                    "buckens that has written it",
                    name, kStateFormat));
  }
  throw IoError(fmt::format("{}: the saved state is damaged: its checksum or size differs; {}",
                            name, remedy(name)));
}

}  // namespace

std::string state_bytes(const base::SavedValues& state) {
  const Hdf5Quiet quiet;
  Hdf5Handle file(sound(H5Fcreate("state", H5F_ACC_TRUNC, H5P_DEFAULT, settings_in_memory().get()),
                        "keep a state in memory"),
                  H5Fclose);
  put_group(file.get(), "numbers", state.numbers);
  put_group(file.get(), "counts", state.counts);
  put_group(file.get(), "texts", packed(state));
  sound(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "complete a state");
  const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
  sound(size < 0 ? -1 : 0, "complete a state");
  std::string out(static_cast<std::size_t>(size), '\0');
  sound(H5Fget_file_image(file.get(), out.data(), out.size()) < 0 ? -1 : 0, "complete a state");
  return sealed(out);
}

std::string sealed(std::string_view content) { return std::string(content) + trailer(content); }

base::SavedValues parse_state(std::string_view bytes, const std::string& name) {
  const std::string_view content = checked(bytes, name);
  const Hdf5Quiet quiet;
  base::SavedValues out;
  try {
    const Hdf5Handle access = settings_in_memory();
    std::string image(content);  // HDF5 wants memory that it could write to
    sound(H5Pset_file_image(access.get(), image.data(), image.size()), "read a file in memory");
    const Hdf5Handle file(sound(H5Fopen("state", H5F_ACC_RDONLY, access.get()), "open the state"),
                          H5Fclose);
    take_group(file.get(), "numbers", image.size(), out.numbers);
    take_group(file.get(), "counts", image.size(), out.counts);
    std::map<std::string, std::vector<std::uint8_t>> texts;
    take_group(file.get(), "texts", image.size(), texts);
    for (const auto& [path, packed_texts] : texts) out.texts[path] = unpacked(packed_texts);
  } catch (const IoError& error) {
    throw IoError(
        fmt::format("{}: the saved state is damaged: {}; {}", name, error.what(), remedy(name)));
  }
  return out;
}

void write_state(const base::SavedValues& state, const std::filesystem::path& path) {
  files::replace_text_file(path, state_bytes(state), files::Lasting::power);
}

base::SavedValues read_state(const std::filesystem::path& path) {
  return parse_state(files::read_text_file(path), path.string());
}

}  // namespace buckens::run_store
