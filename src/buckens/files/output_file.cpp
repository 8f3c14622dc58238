// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/output_file.h"

#include <cerrno>
#include <ctime>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/files/replaced_file.h"

namespace buckens::files {

namespace {

/// What a user can do about a failed write.
std::string remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return " Free space, write elsewhere (-o), or record less (output: every).";
    case EACCES:
    case EPERM:
    case EROFS:
      return " Choose a place where you may write (-o).";
    case ELOOP:
      return " It is a symbolic link; remove it, or write elsewhere (-o).";
    case EPIPE:
      return " The process that takes the data has ended; perhaps the memory was exhausted.";
    default:
      return "";
  }
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, Start start) : path_(path) {
  const int flags = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC;
  switch (start) {
    case Start::empty:
      descriptor_ = ::open(path.c_str(), flags | O_TRUNC, 0666);
      break;
    case Start::anew:
      descriptor_ = open_anew(path.c_str(), O_WRONLY | O_APPEND);
      break;
    case Start::as_it_is:
      descriptor_ = ::open(path.c_str(), flags | O_NOFOLLOW, 0666);
      break;
  }
  if (descriptor_ < 0) fail("open");
}

OutputFile::~OutputFile() {
  if (is_open()) ::close(descriptor_);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this != &other) {
    if (is_open()) ::close(descriptor_);
    path_ = std::move(other.path_);
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

void OutputFile::fail(std::string_view verb) const {
  const int error = errno;
  throw IoError(
      fmt::format("{}: cannot {} the file: {}", path_.string(), verb, system_reason(error)));
}

void OutputFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("write");
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::clear() {
  if (::ftruncate(descriptor_, 0) != 0) fail("empty");
}

bool OutputFile::try_lock() {
  return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

void OutputFile::close() {
  if (is_open() && ::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail("close");
}

int open_anew(const char* path, int flags) {
  struct stat found {};
  if (::lstat(path, &found) == 0) {
    // A device or pipe is meant as it is, never to be removed.
    if (!S_ISREG(found.st_mode) && !S_ISLNK(found.st_mode)) {
      return ::open(path, flags | O_NOFOLLOW | O_CLOEXEC);
    }
    if (::unlink(path) != 0 && errno != ENOENT) return -1;
  }
  return ::open(path, flags | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

std::string system_reason(int error) {
  return fmt::format("{}.{}", std::generic_category().message(error), remedy(error));
}

std::string read_text_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw IoError(fmt::format("{}: is a directory; expected a file.", path.string()));
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw IoError(fmt::format("{}: cannot read the file: {}.", path.string(),
                              std::generic_category().message(errno)));
  }
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad())
    throw IoError(fmt::format("{}: reading stopped before the end of the file.", path.string()));
  return text;
}

void sync_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool is_done = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (is_done) return;
  throw IoError(fmt::format("{}: cannot bring the file to the disk: {}", path.string(),
                            system_reason(error)));
}

void replace_text_file(const std::filesystem::path& path, std::string_view text, Lasting lasting) {
  replace_file(path, lasting, [text](const std::filesystem::path& part) {
    OutputFile file(part, OutputFile::Start::anew);
    file.write(text);
    file.close();
  });
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace buckens::files
