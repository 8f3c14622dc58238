// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  /// Lets all pages leave. Others may read them meanwhile.
  void let_go() const;

 private:
  bool map(int flags, int file);

  char* data_ = nullptr;
  std::size_t bytes_ = 0;
  bool is_on_disk_ = false;
};

/// Lets pages go again and again while it lives: of something that others read once, nobody can
/// tell when.
class LettingGo {
 public:
  explicit LettingGo(const PagesOnDisk& pages);
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
