// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>

namespace buckens_petsc {

/// Memory whose pages are those of a file without a name, so that they can leave at any time and
/// come back when they are read. Where there is no disk for them, it is ordinary memory.
class PagesOnDisk {
 public:
  PagesOnDisk() = default;
  ~PagesOnDisk() { (void)set_aside(0); }
  PagesOnDisk(const PagesOnDisk&) = delete;
  PagesOnDisk& operator=(const PagesOnDisk&) = delete;

  /// @return whether it was possible; what was there before goes
  bool set_aside(std::size_t bytes);
  char* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }
  bool is_on_disk() const { return file_ >= 0; }
  /// Lets all pages of the file leave. Others may read and write them meanwhile.
  void let_go() const;
  /// Brings the first bytes into memory for good, at the same address, and gives back what is
  /// behind them. Where there is no memory, the rest stays in the file. Nobody else may use them
  /// meanwhile.
  void bring_back(std::size_t bytes);

 private:
  bool map(int flags, int file);
  bool take_from_disk(std::size_t at, std::size_t bytes);
  void close_file();

  char* data_ = nullptr;
  std::size_t bytes_ = 0;
  int file_ = -1;                 // −1: all is memory
  std::size_t brought_back_ = 0;  // bytes at the beginning that are no longer the file's
};

/// Lets pages go again and again while it lives: of something that others read or write once,
/// nobody can tell when.
class LettingGo {
 public:
  /// @param between one time and the next
  /// @param most bytes of files that this process may have more than now before they go
  LettingGo(const PagesOnDisk& pages, std::chrono::milliseconds between, std::size_t most = 0);
  ~LettingGo();
  LettingGo(const LettingGo&) = delete;
  LettingGo& operator=(const LettingGo&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ends_;
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace buckens_petsc
