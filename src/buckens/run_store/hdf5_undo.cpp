// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_undo.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/run_files.h"
#include "buckens/run_store/sealed_file.h"

namespace buckens::run_store {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUndoMark = "buckens undo 1\n";

std::string undo_head(const std::string& checkpoint, std::uint64_t length) {
  const std::string text = fmt::format("{}{}length {:020}\n", kUndoMark, checkpoint, length);
  return text + fmt::format("checksum {:016x}\n", base::checksum(text));
}

void append_number(std::string& out, std::uint64_t number) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  out.append(bytes, sizeof number);
}

std::uint64_t undo_number_at(std::string_view text, std::size_t at) {
  std::uint64_t number = 0;
  std::memcpy(&number, text.data() + at, sizeof number);
  return number;
}

void rename_undo(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!fs::exists(from, error)) return;
  fs::rename(from, to, error);
  if (error) {
    throw IoError(fmt::format("{}: cannot rename the file: {}.", from.string(), error.message()));
  }
  files::sync_to_disk(to.has_parent_path() ? to.parent_path() : ".");
}

}  // namespace

Hdf5Undo::Hdf5Undo(const fs::path& directory)
    : path_(directory / kUndoName), aside_(directory / (std::string(kUndoName) + ".old")) {}

Hdf5Undo::~Hdf5Undo() { close(); }

void Hdf5Undo::begin(std::string checkpoint, std::uint64_t length) {
  checkpoint_ = std::move(checkpoint);
  length_ = length;
  kept_.clear();
  waiting_.clear();
  close();
}

int Hdf5Undo::keep(int descriptor, std::uint64_t address, std::size_t size) {
  std::uint64_t from = address;
  const std::uint64_t end = std::min<std::uint64_t>(address + size, length_);
  while (from < end) {
    auto next = kept_.upper_bound(from);
    if (next != kept_.begin()) {
      const auto& [first, last] = *std::prev(next);
      if (last > from) {
        from = last;
        continue;
      }
    }
    const std::uint64_t to = next == kept_.end() ? end : std::min(end, next->first);
    std::vector<std::uint8_t> bytes(to - from);
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::pread(descriptor, bytes.data() + done, bytes.size() - done,
                                    static_cast<off_t>(from + done));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      if (count == 0) break;  // the rest is zero
      done += static_cast<std::size_t>(count);
    }
    take_up(from, std::move(bytes));
    from = to;
  }
  return 0;
}

void Hdf5Undo::take_up(std::uint64_t address, std::vector<std::uint8_t> bytes) {
  if (kept_.empty()) waiting_ = undo_head(checkpoint_, length_);
  kept_[address] = address + bytes.size();
  std::string record;
  append_number(record, address);
  append_number(record, bytes.size());
  record.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  append_number(record, base::checksum(record));
  waiting_ += record;
}

int Hdf5Undo::sync() {
  if (waiting_.empty()) return 0;
  const bool is_new = descriptor_ < 0;
  if (is_new) descriptor_ = files::open_anew(path_.c_str(), O_WRONLY);
  if (descriptor_ < 0) return errno;
  for (std::string_view rest = waiting_; !rest.empty();) {
    const ssize_t count = ::write(descriptor_, rest.data(), rest.size());
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) rest.remove_prefix(static_cast<std::size_t>(count));
  }
  if (::fsync(descriptor_) != 0 && errno != EINVAL) return errno;
  try {
    if (is_new) files::sync_to_disk(path_.has_parent_path() ? path_.parent_path() : ".");
  } catch (const IoError&) {
    return EIO;
  }
  waiting_.clear();
  return 0;
}

void Hdf5Undo::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

void Hdf5Undo::set_aside() { rename_undo(path_, aside_); }

void Hdf5Undo::take_back() {
  std::error_code ignored;
  if (!fs::exists(path_, ignored)) rename_undo(aside_, path_);
}

void Hdf5Undo::discard() {
  begin({}, 0);
  for (const fs::path& file : {path_, aside_}) {
    std::error_code error;
    fs::remove(file, error);
    if (error) {
      throw IoError(fmt::format("{}: cannot remove the file: {}.", file.string(), error.message()));
    }
  }
}

std::shared_ptr<const Undone> read_undone(const fs::path& directory,
                                          const std::string& checkpoint) {
  std::error_code ignored;
  fs::path path = directory / kUndoName;
  if (!fs::exists(path, ignored)) {
    path += ".old";
    // Once the new results have taken their place, it belongs to nothing.
    if (!fs::exists(directory / (std::string(kResultsName) + ".part"), ignored)) return nullptr;
    if (!fs::exists(path, ignored)) return nullptr;
  }
  const std::string text = files::read_text_file(path);
  const std::size_t size = undo_head(checkpoint, 0).size();
  if (text.size() < size) return nullptr;
  auto out = std::make_shared<Undone>();
  const std::string_view digits =
      std::string_view(text).substr(kUndoMark.size() + checkpoint.size() + 7, 20);
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return nullptr;
    out->length = 10 * out->length + static_cast<std::uint64_t>(digit - '0');
  }
  if (text.substr(0, size) != undo_head(checkpoint, out->length)) return nullptr;
  // What follows the last whole record was not needed yet.
  constexpr std::size_t kNumber = sizeof(std::uint64_t);
  for (std::size_t at = size; at + 3 * kNumber <= text.size();) {
    const std::uint64_t count = undo_number_at(text, at + kNumber);
    if (count > text.size() - at - 3 * kNumber) break;
    const std::string_view record = std::string_view(text).substr(at, 2 * kNumber + count);
    if (base::checksum(record) != undo_number_at(text, at + record.size())) break;
    FileBytes bytes;
    bytes.address = undo_number_at(text, at);
    bytes.bytes.assign(record.begin() + 2 * kNumber, record.end());
    if (bytes.address > out->length || count > out->length - bytes.address) return nullptr;
    out->before.push_back(std::move(bytes));
    at += record.size() + kNumber;
  }
  return out;
}

std::string checkpoint_mark(const fs::path& checkpoint) {
  std::ifstream in(checkpoint, std::ios::binary);
  std::string mark(kStateTrailer, '\0');
  in.seekg(-static_cast<std::streamoff>(kStateTrailer), std::ios::end);
  return in.read(mark.data(), static_cast<std::streamsize>(mark.size())) ? mark : std::string();
}

}  // namespace buckens::run_store
