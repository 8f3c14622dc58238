// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/base/task_pool.h"

namespace buckens::base {

/// While it lives, what the calling thread begins before steps can be taken (assembly,
/// factorisations, free vibrations) shares its work among as many threads, where it is large
/// enough; without one, it uses the calling thread alone. No bit of a result depends on it. May be
/// nested: the inner one counts.
class AllowedThreads {
 public:
  /// @param threads ≥ 1, the calling one included; the others start when there is work for them
  explicit AllowedThreads(int threads);
  /// @param pool outlives this object; null: the calling thread alone
  explicit AllowedThreads(TaskPool* pool);
  ~AllowedThreads();
  AllowedThreads(const AllowedThreads&) = delete;
  AllowedThreads& operator=(const AllowedThreads&) = delete;

  /// Threads for what the calling thread begins.
  static int count();
  /// These threads, as long as the innermost object lives; null if there is only one.
  static TaskPool* pool();

 private:
  AllowedThreads* before_;
  int threads_;
  TaskPool* pool_ = nullptr;
  std::unique_ptr<TaskPool> own_;
};

}  // namespace buckens::base
