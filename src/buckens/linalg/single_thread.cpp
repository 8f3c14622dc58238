// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/single_thread.h"

#include <mutex>

#include <cblas.h>
#include <dlfcn.h>

namespace buckens::linalg {

namespace {

/// The OpenMP with which the libraries below were built, if any. Found by name: this library itself
/// is built without it, so there is no other way to know.
struct OpenMp {
  int (*max_threads)() = find<int (*)()>("omp_get_max_threads");
  void (*set_threads)(int) = find<void (*)(int)>("omp_set_num_threads");
  int (*max_levels)() = find<int (*)()>("omp_get_max_active_levels");
  void (*set_levels)(int) = find<void (*)(int)>("omp_set_max_active_levels");

  bool is_there() const {
    return max_threads != nullptr && set_threads != nullptr && max_levels != nullptr &&
           set_levels != nullptr;
  }

 private:
  template <class Function>
  static Function find(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
  }
};

const OpenMp& open_mp() {
  static const OpenMp found;
  return found;
}

/// The number of threads of an OpenBLAS that starts its own: one for the whole process.
struct OwnThreads {
  std::mutex mutex;
  int holders = 0;
  int before = 0;
};

OwnThreads& own_threads() {
  static OwnThreads threads;
  return threads;
}

// OpenBLAS is built without threads (0), with its own (1) or with those of OpenMP (2).
bool blas_has_own_threads() {
  static const bool has = openblas_get_parallel() == 1;
  return has;
}

}  // namespace

SingleThread::SingleThread() {
  if (open_mp().is_there()) {
    threads_ = open_mp().max_threads();
    levels_ = open_mp().max_levels();
    open_mp().set_threads(1);
    // CHOLMOD explicitly requests four threads, which only this overrides.
    open_mp().set_levels(0);
  }
  if (!blas_has_own_threads()) return;
  OwnThreads& own = own_threads();
  const std::lock_guard lock(own.mutex);
  if (own.holders++ > 0) return;
  own.before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

SingleThread::~SingleThread() {
  if (open_mp().is_there()) {
    open_mp().set_threads(threads_);
    open_mp().set_levels(levels_);
  }
  if (!blas_has_own_threads()) return;
  OwnThreads& own = own_threads();
  const std::lock_guard lock(own.mutex);
  if (--own.holders == 0) openblas_set_num_threads(own.before);
}

}  // namespace buckens::linalg
