// SPDX-License-Identifier: Apache-2.0
#include "pages_on_disk.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "nameless_file.h"

namespace buckens_petsc {

namespace {
// Brought back at a time: these bytes are in memory twice.
constexpr std::size_t kChunk = std::size_t{8} << 20;

std::size_t page_size() { return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)); }

/// Bytes of files that are mapped and in memory of this process.
class MappedFiles {
 public:
  MappedFiles() : file_(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC)) {}
  ~MappedFiles() {
    if (file_ >= 0) ::close(file_);
  }
  MappedFiles(const MappedFiles&) = delete;
  MappedFiles& operator=(const MappedFiles&) = delete;

  std::size_t bytes() const {
    std::array<char, 128> text{};
    unsigned long pages = 0;
    // All pages, those in memory, and of these those of files.
    const bool is_read = file_ >= 0 && ::pread(file_, text.data(), text.size() - 1, 0) > 0 &&
                         std::sscanf(text.data(), "%*u %*u %lu", &pages) == 1;
    return is_read ? pages * page_size() : 0;
  }

 private:
  int file_;
};

/// Threads that begin while this lives get no signals: those are for the thread that waits for
/// them.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~NoSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

bool PagesOnDisk::map(int flags, int file) {
  void* found = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, flags, file, 0);
  if (found != MAP_FAILED) data_ = static_cast<char*>(found);
  return found != MAP_FAILED;
}

bool PagesOnDisk::set_aside(std::size_t bytes) {
  if (data_ != nullptr) ::munmap(data_, bytes_);
  data_ = nullptr;
  bytes_ = bytes;
  is_on_disk_ = false;
  if (bytes == 0) return true;
  const int file = nameless_file();
  if (file >= 0) {
    // All of it now: pages that find no room later would end the process.
    const bool has_room = ::fallocate(file, 0, 0, static_cast<off_t>(bytes)) == 0;
    is_on_disk_ = has_room && map(MAP_SHARED, file);
    ::close(file);
  }
  return is_on_disk_ || map(MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1);
}

void PagesOnDisk::let_go() const {
  if (is_on_disk_) (void)::madvise(data_, bytes_, MADV_DONTNEED);
}

void PagesOnDisk::bring_back(std::size_t bytes) {
  const std::size_t page = page_size();
  const std::size_t end = std::min(bytes_, (bytes + page - 1) / page * page);
  if (data_ == nullptr) return;
  if (is_on_disk_) {
    let_go();  // those further on, beside what comes first
    for (std::size_t at = 0; at < end; at += kChunk) {
      // Where there is no memory for it, the rest stays pages of the file.
      if (!take_from_disk(at, std::min(kChunk, end - at))) return;
    }
    is_on_disk_ = false;
  }
  if (end == bytes_) return;
  (void)::mmap(data_ + end, bytes_ - end, PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
}

/// Puts memory with the same content in the place of some pages of the file.
bool PagesOnDisk::take_from_disk(std::size_t at, std::size_t bytes) {
  void* found = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (found == MAP_FAILED) return false;
  std::memcpy(found, data_ + at, bytes);
  (void)::madvise(data_ + at, bytes, MADV_REMOVE);  // of the file
  return ::mremap(found, bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, data_ + at) != MAP_FAILED;
}

LettingGo::LettingGo(const PagesOnDisk& pages, std::chrono::milliseconds between,
                     std::size_t most) {
  const NoSignals none;
  try {
    thread_ = std::thread([this, &pages, between, most] {
      const MappedFiles files;
      const std::size_t limit = most > 0 ? files.bytes() + most : 0;
      std::unique_lock<std::mutex> lock(mutex_);
      while (!ends_.wait_for(lock, between, [this] { return has_ended_; })) {
        if (most == 0 || files.bytes() > limit) pages.let_go();
      }
    });
  } catch (const std::exception&) {  // without a thread the pages stay
  }
}

LettingGo::~LettingGo() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
  }
  ends_.notify_one();
  if (thread_.joinable()) thread_.join();
}

}  // namespace buckens_petsc
