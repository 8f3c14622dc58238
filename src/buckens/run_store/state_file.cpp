// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/state_file.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/files/replaced_file.h"
#include "buckens/run_store/hdf5_driver.h"
#include "buckens/run_store/hdf5_file.h"
#include "buckens/run_store/sealed_file.h"
#include "buckens/run_store/state_sets.h"

namespace buckens::run_store {

namespace {

constexpr std::size_t kPiece = 1 << 20;  // of a file whose checksum is taken

Hdf5Handle settings_of_states() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The oldest format that will do, which every version of HDF5 reads.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  return access;
}

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

template <class Numbers>
void put_at(hid_t set, std::size_t first, const Numbers& values) {
  if (values.size() == 0) return;
  const PlaceInSet place(set, first, values.size());
  sound(H5Dwrite(set, type_of(*values.data()), place.here.get(), place.there.get(), H5P_DEFAULT,
                 values.data()),
        "write a data set");
}

template <class Number>
void put(hid_t group, const char* name, const std::vector<Number>& values) {
  put_at(data_set<Number>(group, name, values.size()).get(), 0, values);
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

template <class Number>
std::size_t length_of(const std::vector<Number>& list) {
  return list.size();
}
std::size_t length_of(const base::SavedValues::Later& list) { return list.size; }
std::size_t length_of(const base::SavedValues::InFile& list) { return list.size; }

template <class Number>
const std::vector<Number>& made(const std::vector<Number>& list) {
  return list;
}
Eigen::VectorXf made(const base::SavedValues::Later& list) {
  Eigen::VectorXf out = list.make();
  BUCKENS_ASSERT(static_cast<std::size_t>(out.size()) == list.size);
  return out;
}

std::vector<double> made(const base::SavedValues::InFile& list) {
  std::vector<double> out(list.size);
  list.read(std::span(out));
  return out;
}

/// Lists are long: they are written one by one, and never put together here.
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
    put_group(file.get(), "numbers", state.numbers, state.in_file, state.singles, state.later);
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
  return state_trailer(size, checksum);
}

}  // namespace

void write_state(const base::SavedValues& state, const std::filesystem::path& path) {
  files::replace_file(path, files::Lasting::power, [&state](const std::filesystem::path& part) {
    write_content(state, part);
    const std::string end = trailer_of(part);
    files::OutputFile(part, files::OutputFile::Start::as_it_is).write(end);
  });
}

}  // namespace buckens::run_store
