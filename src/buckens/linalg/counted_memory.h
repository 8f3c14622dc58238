// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

#include "buckens/linalg/streaming_memory.h"

namespace buckens::linalg {

/// Bytes that something takes, and at most has taken. Threads may share one.
class MemoryCount {
 public:
  void add(std::ptrdiff_t bytes) {
    const std::ptrdiff_t now = now_ += bytes;
    std::ptrdiff_t most = most_;
    while (most < now && !most_.compare_exchange_weak(most, now)) {
    }
  }
  std::ptrdiff_t most() const { return most_; }

 private:
  std::atomic<std::ptrdiff_t> now_ = 0, most_ = 0;
};

/// Memory that is counted while it exists.
class CountedMemory {
 public:
  CountedMemory() = default;
  /// @param size numbers @param count must outlive this object @throws std::bad_alloc
  CountedMemory(std::ptrdiff_t size, MemoryCount& count)
      : memory_(static_cast<std::size_t>(size)), count_(&count), counted_(bytes(size)) {
    count_->add(counted_);
  }
  CountedMemory(CountedMemory&& other) noexcept { swap(other); }
  CountedMemory& operator=(CountedMemory&& other) noexcept {
    CountedMemory old;
    old.swap(*this);
    swap(other);
    return *this;
  }
  ~CountedMemory() {
    if (count_ != nullptr) count_->add(-counted_);
  }

  double* data() { return memory_.data(); }
  std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(memory_.size()); }
  /// Returns the numbers begin … end to the system, whose contents are lost. Once for each.
  void give_up(std::ptrdiff_t begin, std::ptrdiff_t end) {
    give_up_pages(data() + begin, data() + end);
    counted_ -= bytes(end - begin);
    count_->add(-bytes(end - begin));
  }

 private:
  static std::ptrdiff_t bytes(std::ptrdiff_t size) {
    return size * static_cast<std::ptrdiff_t>(sizeof(double));
  }
  void swap(CountedMemory& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(count_, other.count_);
    std::swap(counted_, other.counted_);
  }

  StreamingMemory memory_;
  MemoryCount* count_ = nullptr;
  std::ptrdiff_t counted_ = 0;
};

}  // namespace buckens::linalg
