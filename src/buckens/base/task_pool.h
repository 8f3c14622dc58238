// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>

namespace buckens {

/// A pool of threads that sleep until there are tasks to run in parallel.
///
/// run() allocates nothing. Tasks must not depend on which thread runs them, so that results are
/// the same with any number of threads.
class TaskPool {
 public:
  /// @param threads ≥ 1, including the caller of run(): `threads` − 1 are started here
  explicit TaskPool(int threads);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  int threads() const;
  /// Number of threads that run() uses when called from here: 1 inside a task. No more tasks than
  /// that may wait for each other.
  int available() const;

  /// Runs task(0) … task(count − 1), each once, and returns when all have finished. A call from
  /// inside a task runs its tasks in sequence.
  /// @throws the exception of the task with the lowest number that threw
  template <class Task>
  void run(int count, Task&& task) {
    run_each(
        count,
        [](void* context, int k) { (*static_cast<std::remove_reference_t<Task>*>(context))(k); },
        const_cast<void*>(static_cast<const void*>(&task)));
  }

 private:
  using Function = void (*)(void* context, int task);
  void run_each(int count, Function function, void* context);

  struct Shared;
  std::unique_ptr<Shared> shared_;
};

/// The same without a pool, in sequence.
template <class Task>
void run_tasks(TaskPool* pool, int count, Task&& task) {
  if (pool != nullptr) {
    pool->run(count, task);
  } else {
    for (int k = 0; k < count; ++k) task(k);
  }
}

/// Runs task(begin, end) for ranges that together are 0 … count − 1, one per thread, none empty.
template <class Task>
void run_ranges(TaskPool* pool, int count, Task&& task) {
  const int ranges = std::min(pool != nullptr ? pool->available() : 1, count);
  const auto begin = [&](int range) {
    return static_cast<int>(static_cast<long>(count) * range / ranges);
  };
  run_tasks(pool, ranges, [&](int range) { task(begin(range), begin(range + 1)); });
}

}  // namespace buckens
