// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>

#include "buckens/base/sanitizers.h"

// Counts calls of malloc (which operator new and Eigen use), calloc and so on. Include in one
// source of a test program only: it replaces the C library's functions.

namespace buckens::test {

inline std::atomic<long> num_allocations{0};
inline std::atomic<std::size_t> least_counted{0};  // bytes

#if defined(__GLIBC__) && !BUCKENS_IS_SANITIZED
inline constexpr bool kCountsAllocations = true;
#else
inline constexpr bool kCountsAllocations = false;  // sanitizers have their own malloc
#endif

/// Allocations of all threads while f runs. @param least count only those of at least so many bytes
template <class F>
long count_allocations(F&& f, std::size_t least = 0) {
  least_counted = least;
  const long before = num_allocations.load();
  f();
  return num_allocations.load() - before;
}

inline void note_allocation(std::size_t size) {
  if (size >= least_counted.load(std::memory_order_relaxed)) {
    num_allocations.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace buckens::test

#if defined(__GLIBC__) && !BUCKENS_IS_SANITIZED
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* malloc(std::size_t size) {
  buckens::test::note_allocation(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  buckens::test::note_allocation(count * size);
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  buckens::test::note_allocation(size);
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  buckens::test::note_allocation(size);
  return __libc_memalign(alignment, size);
}
}
#endif
