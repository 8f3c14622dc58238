// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/task_pool.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace buckens {

namespace {
thread_local bool is_inside_task = false;
}  // namespace

struct TaskPool::Shared {
  std::mutex turn;  // held by the caller of run(): one set of tasks at a time
  std::mutex mutex;
  std::condition_variable has_tasks, is_done;
  Function function = nullptr;
  void* context = nullptr;
  int count = 0;
  int next = 0;    // first task that nobody has taken
  int ended = 0;   // tasks carried out
  int failed = 0;  // number of the task that threw `error`
  std::exception_ptr error;
  bool must_stop = false;
  std::vector<std::thread> threads;

  void keep_error(int task) {
    if (error == nullptr || task < failed) {
      error = std::current_exception();
      failed = task;
    }
  }

  /// Runs tasks as long as there are any. @param lock of `mutex`, held on entry and return
  void work(std::unique_lock<std::mutex>& lock) {
    while (next < count) {
      const int task = next++;
      lock.unlock();
      is_inside_task = true;
      try {
        function(context, task);
        is_inside_task = false;
        lock.lock();
      } catch (...) {
        is_inside_task = false;
        lock.lock();
        keep_error(task);
      }
      if (++ended == count) is_done.notify_all();
    }
  }

  void serve() {
    std::unique_lock lock(mutex);
    while (true) {
      has_tasks.wait(lock, [this] { return must_stop || next < count; });
      if (must_stop) return;
      work(lock);
    }
  }

  void stop() {
    {
      const std::scoped_lock lock(mutex);
      must_stop = true;
    }
    has_tasks.notify_all();
    for (std::thread& thread : threads) thread.join();
  }
};

TaskPool::TaskPool(int threads) : shared_(std::make_unique<Shared>()) {
  try {
    for (int k = 1; k < threads; ++k) {
      shared_->threads.emplace_back([shared = shared_.get()] { shared->serve(); });
    }
  } catch (...) {
    shared_->stop();
    throw;
  }
}

TaskPool::~TaskPool() { shared_->stop(); }

int TaskPool::threads() const { return static_cast<int>(shared_->threads.size()) + 1; }

int TaskPool::available() const { return is_inside_task ? 1 : threads(); }

void TaskPool::run_each(int count, Function function, void* context) {
  if (count <= 0) return;
  if (is_inside_task || shared_->threads.empty() || count == 1) {
    for (int k = 0; k < count; ++k) function(context, k);
    return;
  }
  const std::scoped_lock turn(shared_->turn);
  std::unique_lock lock(shared_->mutex);
  shared_->function = function;
  shared_->context = context;
  shared_->next = shared_->ended = 0;
  shared_->count = count;
  shared_->has_tasks.notify_all();
  shared_->work(lock);
  shared_->is_done.wait(lock, [this] { return shared_->ended == shared_->count; });
  shared_->count = shared_->next = shared_->ended = 0;
  if (const std::exception_ptr error = std::exchange(shared_->error, nullptr)) {
    std::rethrow_exception(error);
  }
}

}  // namespace buckens
