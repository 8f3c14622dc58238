// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "buckens/linalg/counted_memory.h"

namespace buckens::linalg {

/// Memory that one task after the other works in: new pages cost as much as a tenth of the work.
class Rooms {
 public:
  explicit Rooms(MemoryCount& count) : count_(count) {}

  CountedMemory take(std::ptrdiff_t size) {
    CountedMemory room;
    {
      const std::scoped_lock lock(mutex_);
      if (!spare_.empty()) {
        room = std::move(spare_.back());
        spare_.pop_back();
      }
    }
    if (room.size() < size) {
      room = CountedMemory();  // before the larger one, so that both never exist
      room = CountedMemory(size, count_);
    }
    return room;
  }

  void give_back(CountedMemory room) {
    const std::scoped_lock lock(mutex_);
    spare_.push_back(std::move(room));
  }

  /// Frees what has been given back.
  void clear() {
    const std::scoped_lock lock(mutex_);
    spare_.clear();
  }

 private:
  MemoryCount& count_;
  std::mutex mutex_;
  std::vector<CountedMemory> spare_;
};

}  // namespace buckens::linalg
