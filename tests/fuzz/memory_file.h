// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace buckens::fuzz {

/// A file in memory, for readers that take the path of a file.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("input", 0)) {}

  /// Puts the input in place of what was there. @return its path
  std::filesystem::path write(const std::uint8_t* data, std::size_t size) const {
    if (ftruncate(descriptor_, 0) != 0) return {};
    std::size_t done = 0;
    while (done < size) {
      const ssize_t count = pwrite(descriptor_, data + done, size - done, static_cast<off_t>(done));
      if (count <= 0) return {};
      done += static_cast<std::size_t>(count);
    }
    return "/proc/self/fd/" + std::to_string(descriptor_);
  }

 private:
  int descriptor_;
};

}  // namespace buckens::fuzz
