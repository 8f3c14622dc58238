// SPDX-License-Identifier: Apache-2.0
#include "pages_on_disk.h"

#include <chrono>
#include <csignal>
#include <exception>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "nameless_file.h"

namespace buckens_petsc {

namespace {
// Short beside a factorisation that needs the memory, and long beside letting pages go.
constexpr std::chrono::milliseconds kBetween{50};

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
    const bool has_room = ::posix_fallocate(file, 0, static_cast<off_t>(bytes)) == 0;
    is_on_disk_ = has_room && map(MAP_SHARED, file);
    ::close(file);
  }
  return is_on_disk_ || map(MAP_PRIVATE | MAP_ANONYMOUS, -1);
}

void PagesOnDisk::let_go() const {
  if (is_on_disk_) (void)::madvise(data_, bytes_, MADV_DONTNEED);
}

LettingGo::LettingGo(const PagesOnDisk& pages) {
  const NoSignals none;
  try {
    thread_ = std::thread([this, &pages] {
      std::unique_lock<std::mutex> lock(mutex_);
      while (!ends_.wait_for(lock, kBetween, [this] { return has_ended_; })) pages.let_go();
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
