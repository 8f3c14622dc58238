// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace buckens::linalg {

/// Doubles that are read in one long sweep: aligned to cache lines and, if there are many, on huge
/// pages (where the system provides them), which avoids most TLB misses. Many go back to the system
/// when they are freed, rather than wait in the heap.
class StreamingMemory {
 public:
  StreamingMemory() = default;
  /// Not initialised. @throws std::bad_alloc
  explicit StreamingMemory(std::size_t count);

  double* data() { return values_.get(); }
  const double* data() const { return values_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    Free() : count(0) {}
    explicit Free(std::size_t all) : count(all) {}
    void operator()(double* values) const;
    std::size_t count;
  };
  std::unique_ptr<double[], Free> values_;
  std::size_t size_ = 0;
};

/// Returns the whole pages of [begin, end) to the system, where possible; their contents are lost.
/// The memory stays allocated and is freed as usual.
void give_up_pages(const double* begin, const double* end);

}  // namespace buckens::linalg
