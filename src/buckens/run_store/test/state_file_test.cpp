// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/state_file.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::run_store {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

base::SavedValues some_state() {
  base::SavedValues out;
  out.numbers["state/t"] = {0.1};
  out.numbers["state/bodies/0/d"] = {1.0 / 3.0, -0.0, 1e-308, 5e-324};
  out.numbers["none"] = {};
  out.counts["ticks"] = {1L << 55, -7};
  out.texts["model"] = {"bodies.rod.mass: 1", "", "läuft"};
  out.texts["version"] = {};
  return out;
}

TEST(StateFile, GivesTheSameBitsAgain) {
  const base::SavedValues state = some_state();
  const std::string bytes = state_bytes(state);
  EXPECT_EQ(parse_state(bytes, "s"), state);
  EXPECT_TRUE(std::signbit(parse_state(bytes, "s").numbers["state/bodies/0/d"][1]));
  EXPECT_EQ(state_bytes(state), bytes);  // no time of day in it
}

TEST(StateFile, EveryCutAndEveryFlippedByteIsRefused) {
  const std::string bytes = state_bytes(some_state());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_THROW(parse_state(std::string_view(bytes).substr(0, size), "s"), IoError) << size;
  }
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    EXPECT_THROW(parse_state(damaged, "s"), IoError) << at;
  }
}

/// A file whose checksum is right although its content is invalid: it must not cause a crash.
TEST(StateFile, ForeignContentWithASoundTrailerIsRefused) {
  const std::string bytes = state_bytes(some_state());
  EXPECT_THAT([&] { parse_state(sealed("no HDF5 at all"), "s"); },
              ThrowsMessage<IoError>(HasSubstr("s: the saved state is damaged")));
  const std::string content = bytes.substr(0, bytes.size() - kStateTrailer);
  EXPECT_EQ(sealed(content), bytes);
  for (std::size_t size = 0; size < content.size(); size += 101) {
    EXPECT_THROW(parse_state(sealed(content.substr(0, size)), "s"), IoError) << size;
  }
}

}  // namespace
}  // namespace buckens::run_store
