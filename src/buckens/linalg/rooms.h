// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "buckens/linalg/streaming_memory.h"

namespace buckens::linalg {

/// Memory that one task after the other works in: new pages cost as much as a tenth of the work.
class Rooms {
 public:
  StreamingMemory take(std::size_t size) {
    StreamingMemory room;
    {
      const std::scoped_lock lock(mutex_);
      if (!spare_.empty()) {
        room = std::move(spare_.back());
        spare_.pop_back();
      }
    }
    if (room.size() < size) {
      room = StreamingMemory();  // before the larger one, so that both never exist
      room = StreamingMemory(size);
    }
    return room;
  }

  void give_back(StreamingMemory room) {
    const std::scoped_lock lock(mutex_);
    spare_.push_back(std::move(room));
  }

  /// Frees what has been given back.
  void clear() { spare_.clear(); }

 private:
  std::mutex mutex_;
  std::vector<StreamingMemory> spare_;
};

}  // namespace buckens::linalg
