// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace buckens::linalg {

/// 128 bits of a long run of bytes, as fast as memory is read. Tells accidents apart, not attacks.
class ContentHash {
 public:
  void add(const void* bytes, std::size_t count);
  void add(std::uint64_t number) { add(&number, sizeof number); }

  std::array<std::uint64_t, 2> value() const;
  /// 32 hexadecimal digits.
  std::string text() const;

 private:
  std::array<std::uint64_t, 4> lanes_ = {0x243f6a8885a308d3U, 0x13198a2e03707344U,
                                         0xa4093822299f31d0U, 0x082efa98ec4e6c89U};
  std::uint64_t count_ = 0;
};

}  // namespace buckens::linalg
