// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/streaming_memory.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace buckens::linalg {

namespace {
constexpr std::size_t kLine = 64;
constexpr std::size_t kHugePage = std::size_t{1} << 21U;
}  // namespace

StreamingMemory::StreamingMemory(std::size_t count) : size_(count) {
  if (count == 0) return;
  const std::size_t bytes = count * sizeof(double);
  const std::size_t unit = bytes >= kHugePage ? kHugePage : kLine;
  const std::size_t whole = (bytes + unit - 1) / unit * unit;
  values_ = {static_cast<double*>(std::aligned_alloc(unit, whole)), Free{count}};
  if (values_ == nullptr) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  // Only a request: if not granted, it costs time only.
  if (unit == kHugePage) static_cast<void>(madvise(values_.get(), whole, MADV_HUGEPAGE));
#endif
}

void give_up_pages(const double* begin, const double* end) {
#if defined(__linux__)
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const std::uintptr_t last = reinterpret_cast<std::uintptr_t>(end) / page * page;
  if (first >= last) return;
  // Also only a request; only memory of this process is ever passed here.
  static_cast<void>(madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED));
#else
  static_cast<void>(begin);
  static_cast<void>(end);
#endif
}

void StreamingMemory::Free::operator()(double* values) const {
  if (count * sizeof(double) >= kHugePage) give_up_pages(values, values + count);
  std::free(values);
}

}  // namespace buckens::linalg
