// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/tree_tasks.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <queue>

namespace buckens::linalg {

namespace {

class Forest {
 public:
  Forest(const std::vector<int>& parent, const std::function<void(int)>& task)
      : parent_(parent), task_(task), missing_(parent.size()), left_(parent.size()) {
    for (const int p : parent) {
      if (p >= 0) ++missing_[static_cast<std::size_t>(p)];
    }
    for (std::size_t k = 0; k < parent.size(); ++k) {
      if (missing_[k] == 0) ready_.push(static_cast<int>(k));
    }
  }

  /// Of one thread: carries tasks out until there are none, waiting for those that others are at.
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return !ready_.empty() || left_ == 0; });
      if (left_ == 0) return;
      const int task = ready_.top();
      ready_.pop();
      lock.unlock();
      try {
        task_(task);
      } catch (...) {
        lock.lock();
        left_ = 0;  // the others end too
        changed_.notify_all();
        throw;
      }
      lock.lock();
      if (left_ > 0) finish(task);
    }
  }

 private:
  void finish(int task) {
    const int above = parent_[static_cast<std::size_t>(task)];
    const bool is_last = above >= 0 && --missing_[static_cast<std::size_t>(above)] == 0;
    if (is_last) ready_.push(above);
    if (--left_ == 0 || is_last) changed_.notify_all();
  }

  const std::vector<int>& parent_;
  const std::function<void(int)>& task_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<int> missing_;  // tasks right below each that have not finished
  std::size_t left_;
  std::priority_queue<int> ready_;
};

}  // namespace

void run_tree(TaskPool* pool, const std::vector<int>& parent,
              const std::function<void(int)>& task) {
  Forest forest(parent, task);
  const int threads = pool == nullptr ? 1 : pool->available();
  run_tasks(pool, threads, [&forest](int) { forest.work(); });
}

}  // namespace buckens::linalg
