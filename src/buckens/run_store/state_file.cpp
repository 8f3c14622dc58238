// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/state_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/files/replaced_file.h"
#include "buckens/run_store/hdf5_driver.h"
#include "buckens/run_store/hdf5_file.h"
#include "buckens/run_store/run_files.h"

namespace buckens::run_store {

namespace {

constexpr std::string_view kMark = "\nbuckens state\n";
constexpr std::string_view kHdf5Mark = "\x89HDF";
constexpr std::size_t kIncrement = 1 << 16;  // by which a file in memory grows
constexpr std::size_t kPiece = 1 << 20;      // of a file whose checksum is taken

std::string trailer(std::uintmax_t size, std::uint64_t checksum) {
  std::string out =
      fmt::format("{}format {}\nbytes {}\nchecksum {:016x}\n", kMark, kStateFormat, size, checksum);
  out.insert(out.size() - 1, kStateTrailer - out.size(), ' ');
  return out;
}

std::string trailer(std::string_view bytes) { return trailer(bytes.size(), base::checksum(bytes)); }

hid_t sound(hid_t id, const char* what) {
  if (id < 0) throw IoError(fmt::format("cannot {}: {}", what, hdf5_reason()));
  return id;
}

Hdf5Handle settings_of_states() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Images of newer formats have a checksum that their own writer has made wrong (HDF5 1.10).
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  return access;
}

Hdf5Handle settings_in_memory() {
  Hdf5Handle access = settings_of_states();
  sound(H5Pset_fapl_core(access.get(), kIncrement, 0), "keep a file in memory");
  return access;
}

hid_t type_of(double) { return H5T_IEEE_F64LE; }
hid_t type_of(float) { return H5T_IEEE_F32LE; }
hid_t type_of(std::int64_t) { return H5T_STD_I64LE; }
hid_t type_of(std::uint8_t) { return H5T_STD_U8LE; }

/// Without times of day: equal states are equal files.
Hdf5Handle without_times(hid_t kind) {
  Hdf5Handle settings(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(settings.get(), false);
  return settings;
}

/// Makes a data set of one dimension.
template <class Number>
Hdf5Handle data_set(hid_t group, const char* name, std::size_t size) {
  const hsize_t extent = size;
  const Hdf5Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  return {sound(H5Dcreate2(group, name, type_of(Number{}), space.get(), H5P_DEFAULT,
                           without_times(H5P_DATASET_CREATE).get(), H5P_DEFAULT),
                "write a data set"),
          H5Dclose};
}

/// Where a list is in a data set, for H5Dwrite() and H5Dread().
struct Place {
  Place(hid_t set, hsize_t first, hsize_t count)
      : there(H5Dget_space(set), H5Sclose), here(H5Screate_simple(1, &count, nullptr), H5Sclose) {
    sound(H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr),
          "find a list");
  }

  Hdf5Handle there, here;
};

template <class Numbers>
void put_at(hid_t set, std::size_t first, const Numbers& values) {
  if (values.size() == 0) return;
  const Place place(set, first, values.size());
  sound(H5Dwrite(set, type_of(*values.data()), place.here.get(), place.there.get(), H5P_DEFAULT,
                 values.data()),
        "write a data set");
}

template <class Number>
void put(hid_t group, const char* name, const std::vector<Number>& values) {
  put_at(data_set<Number>(group, name, values.size()).get(), 0, values);
}

/// A data set of one dimension that is there.
template <class Number>
class FoundSet {
 public:
  /// @param most entries that the file can hold at all
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
  std::vector<Number> take(std::size_t first, std::size_t count) const {
    std::vector<Number> values(count);
    if (values.empty()) return values;
    const Place place(set_.get(), first, count);
    sound(H5Dread(set_.get(), type_of(Number{}), place.here.get(), place.there.get(), H5P_DEFAULT,
                  values.data()),
          "read a data set");
    return values;
  }
  std::vector<Number> all() const { return take(0, size_); }

 private:
  Hdf5Handle set_;
  std::size_t size_ = 0;
};

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

template <class Number>
std::size_t length_of(const std::vector<Number>& list) {
  return list.size();
}
std::size_t length_of(const base::SavedValues::Later& list) { return list.size; }

template <class Number>
const std::vector<Number>& made(const std::vector<Number>& list) {
  return list;
}
Eigen::VectorXf made(const base::SavedValues::Later& list) {
  Eigen::VectorXf out = list.make();
  BUCKENS_ASSERT(static_cast<std::size_t>(out.size()) == list.size);
  return out;
}

/// Lists are long: they are written and read one by one, and never put together here.
/// @param first its numbers have the type of the file, to which HDF5 converts others
template <class Map, class... Maps>
void put_group(hid_t file, const char* name, const Map& first, const Maps&... more) {
  const Hdf5Handle group(
      sound(H5Gcreate2(file, name, H5P_DEFAULT, without_times(H5P_GROUP_CREATE).get(), H5P_DEFAULT),
            "write a group"),
      H5Gclose);
  const auto visit = [&](auto&& visitor) {
    const auto visit_lists = [&visitor](const auto& map) {
      for (const auto& [path, list] : map) visitor(path, list);
    };
    visit_lists(first);
    (visit_lists(more), ...);
  };
  std::string names;
  std::vector<std::int64_t> lengths;
  std::size_t size = 0;
  visit([&](const std::string& path, const auto& list) {
    names += path + '\n';
    lengths.push_back(static_cast<std::int64_t>(length_of(list)));
    size += length_of(list);
  });
  put(group.get(), "names", bytes_of(names));
  put(group.get(), "lengths", lengths);
  const Hdf5Handle values =
      data_set<typename Map::mapped_type::value_type>(group.get(), "values", size);
  std::size_t at = 0;
  visit([&](const std::string&, const auto& list) {
    put_at(values.get(), at, made(list));
    at += length_of(list);
  });
}

template <class Map>
void take_group(hid_t file, const char* name, std::size_t size, Map& map) {
  using Number = typename Map::mapped_type::value_type;
  const Hdf5Handle group(sound(H5Gopen2(file, name, H5P_DEFAULT), "find a group"), H5Gclose);
  const auto names = FoundSet<std::uint8_t>(group.get(), "names", size).all();
  const auto lengths =
      FoundSet<std::int64_t>(group.get(), "lengths", size / sizeof(std::int64_t)).all();
  const FoundSet<Number> values(group.get(), "values", size / sizeof(Number));
  std::size_t at = 0;
  auto letter = names.begin();
  for (const std::int64_t length : lengths) {
    std::string path;
    while (letter != names.end() && *letter != '\n') path += static_cast<char>(*letter++);
    const bool is_sound = letter != names.end() && length >= 0 &&
                          static_cast<std::uint64_t>(length) <= values.size() - at;
    if (!is_sound) throw IoError("names and lengths do not fit together");
    ++letter;
    map[path] = values.take(at, static_cast<std::size_t>(length));
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

/// Writes list after list, so that the file never exists in memory.
void write_content(const base::SavedValues& state, const std::filesystem::path& path) {
  const Hdf5Quiet quiet;
  const Hdf5Handle access = settings_of_states();
  Hdf5WriteFault fault;
  if (!set_plain_driver(access.get(), fault)) {
    throw IoError(fmt::format("cannot write a state: {}", hdf5_reason()));
  }
  Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
  if (fault.error == 0) {
    sound(file.get(), "write a state");
    put_group(file.get(), "numbers", state.numbers, state.singles, state.later);
    put_group(file.get(), "counts", state.counts);
    put_group(file.get(), "texts", packed(state));
    file.reset();
  }
  if (fault.error == 0) return;
  throw IoError(fmt::format("{}: cannot write the file: {}", path.string(),
                            files::system_reason(fault.error)));
}

std::string trailer_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<char> piece(kPiece);
  std::uint64_t checksum = base::checksum({});
  std::uintmax_t size = 0;
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0) {
    const auto count = static_cast<std::size_t>(in.gcount());
    checksum = base::checksum({piece.data(), count}, checksum);
    size += count;
  }
  if (in.bad() || size != std::filesystem::file_size(path)) {
    throw IoError(fmt::format("{}: cannot read what was written; write elsewhere", path.string()));
  }
  return trailer(size, checksum);
}

/// HDF5 copies what it gets, and asks for memory that it could write to.
Hdf5Handle opened(std::string_view content) {
  const Hdf5Handle access = settings_in_memory();
  sound(H5Pset_file_image(access.get(), const_cast<char*>(content.data()), content.size()),
        "read a file in memory");
  return {sound(H5Fopen("state", H5F_ACC_RDONLY, access.get()), "open the state"), H5Fclose};
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

std::string sealed(std::string_view content) { return std::string(content) + trailer(content); }

base::SavedValues parse_state(std::string_view bytes, const std::string& name) {
  const std::string_view content = checked(bytes, name);
  const Hdf5Quiet quiet;
  base::SavedValues out;
  try {
    const Hdf5Handle file = opened(content);
    take_group(file.get(), "numbers", content.size(), out.numbers);
    take_group(file.get(), "counts", content.size(), out.counts);
    std::map<std::string, std::vector<std::uint8_t>> texts;
    take_group(file.get(), "texts", content.size(), texts);
    for (const auto& [path, packed_texts] : texts) out.texts[path] = unpacked(packed_texts);
  } catch (const IoError& error) {
    throw IoError(
        fmt::format("{}: the saved state is damaged: {}; {}", name, error.what(), remedy(name)));
  }
  return out;
}

void write_state(const base::SavedValues& state, const std::filesystem::path& path) {
  files::replace_file(path, files::Lasting::power, [&state](const std::filesystem::path& part) {
    write_content(state, part);
    const std::string end = trailer_of(part);
    files::OutputFile(part, files::OutputFile::Start::as_it_is).write(end);
  });
}

base::SavedValues read_state(const std::filesystem::path& path) {
  return parse_state(files::read_text_file(path), path.string());
}

}  // namespace buckens::run_store
