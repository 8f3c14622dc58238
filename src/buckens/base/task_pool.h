// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <type_traits>

namespace buckens {

/// Threads that sleep until there are tasks to run concurrently.
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
  /// Threads that a call of run() from here uses: 1 inside a task. Only so many tasks may wait for
  /// each other.
  int available() const;

  /// Runs task(0) … task(count − 1), each once, and returns when all have finished. A call from
  /// inside a task runs its tasks one after the other.
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

/// The same without a pool: one after the other.
template <class Task>
void run_tasks(TaskPool* pool, int count, Task&& task) {
  if (pool != nullptr) {
    pool->run(count, task);
  } else {
    for (int k = 0; k < count; ++k) task(k);
  }
}

}  // namespace buckens
