// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <sys/types.h>

namespace buckens_petsc {

/// Arrays that nobody needs for a while, in a file without a name, so that their memory is free for
/// something else. Where there is no disk for them, they stay in memory.
class ArraysAside {
 public:
  ArraysAside();
  ~ArraysAside();
  ArraysAside(const ArraysAside&) = delete;
  ArraysAside& operator=(const ArraysAside&) = delete;

  /// Empties the array, if the disk takes it. It must live until bring_back().
  template <class T>
  void put(std::vector<T>& array) {
    const std::size_t count = array.size();
    const off_t at = end_;
    if (count * sizeof(T) < kLeast || !write(array.data(), count * sizeof(T))) return;
    returns_.push_back([this, &array, count, at] {
      array.resize(count);
      return read(array.data(), count * sizeof(T), at);
    });
    std::vector<T>().swap(array);  // at last: where there was no memory for the above, it stays
  }

  /// Fills all arrays again. @return whether the disk gave them back
  /// @throws std::bad_alloc
  bool bring_back();

 private:
  static constexpr std::size_t kLeast = std::size_t{1} << 16;  // bytes worth a call

  bool write(const void* bytes, std::size_t size);
  bool read(void* bytes, std::size_t size, off_t at) const;

  int file_ = -1;
  off_t end_ = 0;
  std::vector<std::function<bool()>> returns_;
};

}  // namespace buckens_petsc
