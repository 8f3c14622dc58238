// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/checksum.h"

#include <cstddef>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace buckens::base {
namespace {

// Test vectors of the draft that defines FNV-1a.
static_assert(checksum("") == 0xcbf29ce484222325U);
static_assert(checksum("a") == 0xaf63dc4c8601ec8cU);
static_assert(checksum("foobar") == 0x85944171f73967e8U);

TEST(Checksum, OneChangedBitChangesIt) {
  const std::string_view text = "a saved state";
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string other(text);
      other[i] = static_cast<char>(other[i] ^ (1 << bit));
      EXPECT_NE(checksum(other), checksum(text)) << i << ' ' << bit;
    }
  }
}

}  // namespace
}  // namespace buckens::base
