// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/sealed_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"
#include "buckens/run_store/run_files.h"

namespace buckens::run_store {

namespace {

constexpr std::string_view kMark = "\nbuckens state\n";
constexpr std::string_view kHdf5Mark = "\x89HDF";

/// What helps if a state is damaged. A checkpoint was written by its run, which ended.
std::string_view remedy(const std::filesystem::path& path) {
  return path.filename() == kCheckpointName
             ? "the run cannot be continued; run the model from the start, or from a state saved "
               "with --save-state"
             : "save it again";
}

/// @return fewer bytes only at the end of the file; negative: errno tells
ssize_t read_at(int descriptor, std::uint64_t first, std::size_t count, char* to) noexcept {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t more =
        ::pread(descriptor, to + done, count - done, static_cast<off_t>(first + done));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) return -1;
    if (more == 0) break;
    done += static_cast<std::size_t>(more);
  }
  return static_cast<ssize_t>(done);
}

/// @return bytes in the file
std::uint64_t open_to_read(const std::filesystem::path& path, int& descriptor) {
  descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    throw IoError(fmt::format("{}: cannot read the file: {}.", path.string(),
                              std::generic_category().message(errno)));
  }
  if (S_ISREG(status.st_mode)) return static_cast<std::uint64_t>(status.st_size);
  throw IoError(fmt::format("{}: is {}; expected a file.", path.string(),
                            S_ISDIR(status.st_mode) ? "a directory" : "no file on a disk"));
}

}  // namespace

std::string state_trailer(std::uint64_t size, std::uint64_t checksum) {
  std::string out =
      fmt::format("{}format {}\nbytes {}\nchecksum {:016x}\n", kMark, kStateFormat, size, checksum);
  out.insert(out.size() - 1, kStateTrailer - out.size(), ' ');
  return out;
}

SealedFile::SealedFile(const std::filesystem::path& path) : path_(path) {
  try {
    const std::uint64_t all = open_to_read(path, descriptor_);
    size_ = all - std::min<std::uint64_t>(all, kStateTrailer);
    const std::string end = bytes_at(size_, static_cast<std::size_t>(all - size_));
    check(end, bytes_at(0, kHdf5Mark.size()) == kHdf5Mark);
    piece_.resize(kPiece);
    if (end != state_trailer(size_, take_checksums())) {
      refuse("its checksum or size differs");
    }
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
}

SealedFile::~SealedFile() { ::close(descriptor_); }

/// @throws IoError unless the end of the file is that of a state of this format
void SealedFile::check(std::string_view end, bool is_hdf5) const {
  if (!end.starts_with(kMark)) {
    throw IoError(fmt::format("{}: {}; use a file that `buckens run --save-state` has written",
                              path_.string(),
                              is_hdf5 ? "this is no saved state, or the end of the file is missing"
                                      : "this is no saved state"));
  }
  const std::string expected = state_trailer(0, 0);
  const std::size_t first_line = expected.find('\n', kMark.size());
  if (end.substr(0, first_line) == std::string_view(expected).substr(0, first_line)) return;
  throw IoError(
      fmt::format("{}: the saved state has another format than {}; use the version of "
                  "buckens that has written it",
                  path_.string(), kStateFormat));
}

std::string SealedFile::bytes_at(std::uint64_t first, std::size_t count) const {
  std::string out(count, '\0');
  const ssize_t found = read_at(descriptor_, first, count, out.data());
  if (found < 0) {
    throw IoError(fmt::format("{}: reading stopped before the end of the file.", path_.string()));
  }
  out.resize(static_cast<std::size_t>(found));
  return out;
}

std::size_t SealedFile::size_of_piece(std::uint64_t piece) const {
  return static_cast<std::size_t>(std::min(kPiece, size_ - piece * kPiece));
}

std::uint64_t SealedFile::take_checksums() {
  checksums_.push_back(base::checksum({}));
  for (std::uint64_t first = 0; first < size_; first += kPiece) {
    const std::size_t count = size_of_piece(first / kPiece);
    const ssize_t found = read_at(descriptor_, first, count, piece_.data());
    if (found < 0) {
      throw IoError(fmt::format("{}: reading stopped before the end of the file.", path_.string()));
    }
    checksums_.push_back(
        base::checksum({piece_.data(), static_cast<std::size_t>(found)}, checksums_.back()));
  }
  return checksums_.back();
}

bool SealedFile::read_piece(std::uint64_t piece, char* to) const noexcept {
  const std::size_t count = size_of_piece(piece);
  const auto at = static_cast<std::size_t>(piece);
  const bool is_same =
      read_at(descriptor_, piece * kPiece, count, to) == static_cast<ssize_t>(count) &&
      base::checksum({to, count}, checksums_[at]) == checksums_[at + 1];
  has_changed_ = has_changed_ || !is_same;
  return is_same;
}

bool SealedFile::read(std::uint64_t first, std::size_t count, void* to) const noexcept {
  if (has_changed_ || first > size_ || count > size_ - first) return false;
  auto* out = static_cast<char*>(to);
  while (count > 0) {
    const std::uint64_t piece = first / kPiece;
    const auto skipped = static_cast<std::size_t>(first % kPiece);
    const std::size_t here = std::min(size_of_piece(piece) - skipped, count);
    if (here == size_of_piece(piece) && piece != number_) {
      if (!read_piece(piece, out)) return false;
    } else {
      if (piece != number_) {
        number_ = UINT64_MAX;
        if (!read_piece(piece, piece_.data())) return false;
        number_ = piece;
      }
      std::memcpy(out, piece_.data() + skipped, here);
    }
    first += here;
    out += here;
    count -= here;
  }
  return true;
}

void SealedFile::require_unchanged() const {
  if (!has_changed_) return;
  throw IoError(
      fmt::format("{}: the saved state has changed while it was read: it was truncated, "
                  "overwritten, or cannot be read any more; {}",
                  path_.string(), remedy(path_)));
}

void SealedFile::refuse(std::string_view what) const {
  throw IoError(
      fmt::format("{}: the saved state is damaged: {}; {}", path_.string(), what, remedy(path_)));
}

}  // namespace buckens::run_store
