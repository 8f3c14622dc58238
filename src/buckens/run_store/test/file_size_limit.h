// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <fstream>

#include <sys/resource.h>
#include <sys/types.h>

namespace buckens::run_store {

/// During its lifetime, files cannot grow beyond `bytes`: as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    set({bytes, before_.rlim_max});
  }
  ~FileSizeLimit() {
    set(before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  /// For this process and those that write for it.
  static void set(const rlimit& limit) {
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::ifstream children("/proc/thread-self/children");
    for (pid_t child = 0; children >> child;) ::prlimit(child, RLIMIT_FSIZE, &limit, nullptr);
  }

  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace buckens::run_store
