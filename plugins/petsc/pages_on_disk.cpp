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
  close_file();
  data_ = nullptr;
  bytes_ = bytes;
  brought_back_ = 0;
  if (bytes == 0) return true;
  file_ = nameless_file();
  // All of it now: pages that find no room later would end the process.
  if (file_ >= 0 && ::fallocate(file_, 0, 0, static_cast<off_t>(bytes)) == 0 &&
      map(MAP_SHARED, file_)) {
    return true;
  }
  close_file();
  return map(MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1);
}

void PagesOnDisk::close_file() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void PagesOnDisk::let_go() const {
  if (file_ < 0) return;
  (void)::madvise(data_ + brought_back_, bytes_ - brought_back_, MADV_DONTNEED);
}

void PagesOnDisk::bring_back(std::size_t bytes) {
  if (data_ == nullptr) return;
  const std::size_t page = page_size();
  const std::size_t end = std::min(bytes_, (bytes + page - 1) / page * page);
  let_go();  // those further on, beside what comes first
  while (file_ >= 0 && brought_back_ < end) {
    const std::size_t size = std::min(kChunk, end - brought_back_);
    if (!take_from_disk(brought_back_, size)) return;
    brought_back_ += size;
  }
  close_file();
  if (end == bytes_) return;
  (void)::mmap(data_ + end, bytes_ - end, PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
}

/// Puts memory with the same content in the place of some pages of the file.
bool PagesOnDisk::take_from_disk(std::size_t at, std::size_t bytes) {
  void* found = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (found == MAP_FAILED) return false;
  std::memcpy(found, data_ + at, bytes);
  if (::mremap(found, bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, data_ + at) == MAP_FAILED) {
    (void)::munmap(found, bytes);
    return false;
  }
  // The system need not keep or write them any longer.
  (void)::fallocate(file_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(at),
                    static_cast<off_t>(bytes));
  return true;
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
