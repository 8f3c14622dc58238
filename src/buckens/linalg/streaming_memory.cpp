// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/streaming_memory.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
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
  values_.reset(static_cast<double*>(std::aligned_alloc(unit, whole)));
  if (values_ == nullptr) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  // A wish: what does not come true costs time only.
  if (unit == kHugePage) static_cast<void>(madvise(values_.get(), whole, MADV_HUGEPAGE));
#endif
}

void StreamingMemory::Free::operator()(double* values) const { std::free(values); }

}  // namespace buckens::linalg
