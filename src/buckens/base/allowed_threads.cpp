// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/allowed_threads.h"

#include <algorithm>
#include <utility>

namespace buckens::base {

namespace {
thread_local AllowedThreads* innermost_allowed = nullptr;
}  // namespace

AllowedThreads::AllowedThreads(int threads)
    : before_(std::exchange(innermost_allowed, this)), threads_(std::max(1, threads)) {}

AllowedThreads::AllowedThreads(TaskPool* pool)
    : before_(std::exchange(innermost_allowed, this)),
      threads_(pool != nullptr ? pool->threads() : 1),
      pool_(pool) {}

AllowedThreads::~AllowedThreads() { innermost_allowed = before_; }

int AllowedThreads::count() {
  return innermost_allowed != nullptr ? innermost_allowed->threads_ : 1;
}

TaskPool* AllowedThreads::pool() {
  if (count() == 1) return nullptr;
  AllowedThreads& own = *innermost_allowed;
  if (own.pool_ == nullptr) {
    own.own_ = std::make_unique<TaskPool>(own.threads_);
    own.pool_ = own.own_.get();
  }
  return own.pool_;
}

}  // namespace buckens::base
