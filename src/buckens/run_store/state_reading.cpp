// SPDX-License-Identifier: Apache-2.0
// How saved states are read: what is short at once, long lists of numbers when they are asked for.
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "buckens/base/errors.h"
#include "buckens/run_store/hdf5_sealed_driver.h"
#include "buckens/run_store/sealed_file.h"
#include "buckens/run_store/state_file.h"
#include "buckens/run_store/state_sets.h"

namespace buckens::run_store {

namespace {

constexpr std::size_t kLongList = 4096;  // numbers from which on a list stays in the file

/// Lists by name: where they begin, and how long they are.
struct ListPlace {
  std::string path;
  std::size_t first, size;
};

/// @param size bytes of the file
std::vector<ListPlace> lists_in(hid_t group, std::size_t size, std::size_t num_values) {
  const auto names = FoundSet<std::uint8_t>(group, "names", size).all();
  const auto lengths = FoundSet<std::int64_t>(group, "lengths", size / sizeof(std::int64_t)).all();
  std::vector<ListPlace> out;
  std::size_t at = 0;
  auto letter = names.begin();
  for (const std::int64_t length : lengths) {
    std::string path;
    while (letter != names.end() && *letter != '\n') path += static_cast<char>(*letter++);
    const bool is_sound = letter != names.end() && length >= 0 &&
                          static_cast<std::uint64_t>(length) <= num_values - at;
    if (!is_sound) throw IoError("names and lengths do not fit together");
    ++letter;
    out.push_back({std::move(path), at, static_cast<std::size_t>(length)});
    at += static_cast<std::size_t>(length);
  }
  if (at != num_values || letter != names.end()) throw IoError("values are left over");
  return out;
}

/// The file of a state, open as long as lists are in it.
class OpenState final : public base::NumbersInFile {
 public:
  explicit OpenState(const std::filesystem::path& path) : bytes_(path) {
    const Hdf5Quiet quiet;
    watch([&] {
      const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      if (!set_sealed_driver(access.get(), bytes_)) sound(-1, "read the file");
      file_ = {sound(H5Fopen("state", H5F_ACC_RDONLY, access.get()), "open the state"), H5Fclose};
      numbers_.emplace(group("numbers").get(), "values", size() / sizeof(double));
    });
  }
  ~OpenState() override {
    const Hdf5Quiet quiet;
    numbers_.reset();
    file_.reset();
  }
  OpenState(const OpenState&) = delete;
  OpenState& operator=(const OpenState&) = delete;

  void read(std::size_t first, std::span<double> to) const override { take(first, to); }
  void read(std::size_t first, std::span<float> to) const override { take(first, to); }

  /// Everything but long lists of numbers.
  /// @param self for those
  static base::SavedValues content(const std::shared_ptr<const OpenState>& self) {
    const Hdf5Quiet quiet;
    base::SavedValues out;
    self->watch([&] {
      self->take_numbers(self, out);
      self->take_group("counts", out.counts);
      std::map<std::string, std::vector<std::uint8_t>> texts;
      self->take_group("texts", texts);
      for (const auto& [path, packed] : texts) out.texts[path] = unpacked(packed);
    });
    return out;
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(bytes_.size()); }
  Hdf5Handle group(const char* name) const {
    return {sound(H5Gopen2(file_.get(), name, H5P_DEFAULT), "find a group"), H5Gclose};
  }

  /// Does what reads. @throws IoError saying what has become of the file
  template <class Work>
  void watch(Work&& work) const {
    try {
      work();
    } catch (const IoError& error) {
      bytes_.require_unchanged();
      bytes_.refuse(error.what());
    }
  }

  template <class Number>
  void take(std::size_t first, std::span<Number> to) const {
    const std::scoped_lock lock(turn_);
    const Hdf5Quiet quiet;
    watch([&] { numbers_->take(first, to); });
  }

  void take_numbers(const std::shared_ptr<const OpenState>& self, base::SavedValues& out) const {
    for (ListPlace& list : lists_in(group("numbers").get(), size(), numbers_->size())) {
      if (list.size >= kLongList) {
        out.in_file[std::move(list.path)] = {self, list.first, list.size};
        continue;
      }
      std::vector<double>& values = out.numbers[std::move(list.path)];
      values.resize(list.size);
      numbers_->take(list.first, values);
    }
  }

  template <class Map>
  void take_group(const char* name, Map& map) const {
    using Number = typename Map::mapped_type::value_type;
    const Hdf5Handle from = group(name);
    const FoundSet<Number> all(from.get(), "values", size() / sizeof(Number));
    for (ListPlace& list : lists_in(from.get(), size(), all.size())) {
      auto& values = map[std::move(list.path)];
      values.resize(list.size);
      all.take(list.first, values);
    }
  }

  static std::vector<std::string> unpacked(const std::vector<std::uint8_t>& bytes) {
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

  SealedFile bytes_;
  Hdf5Handle file_;
  std::optional<FoundSet<double>> numbers_;
  mutable std::mutex turn_;  // states are copied, and restored by several threads
};

}  // namespace

base::SavedValues read_state(const std::filesystem::path& path) {
  return OpenState::content(std::make_shared<const OpenState>(path));
}

}  // namespace buckens::run_store
