// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/content_hash.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

namespace buckens::linalg {

namespace {

constexpr std::uint64_t kFactor = 0x9fb21c651e98df25U;

std::uint64_t stir(std::uint64_t lane, std::uint64_t word) {
  return std::rotl((lane ^ word) * kFactor, 27) + word;
}

std::uint64_t settle(std::uint64_t x) {
  x = (x ^ (x >> 32U)) * kFactor;
  x = (x ^ (x >> 29U)) * 0xbf58476d1ce4e5b9U;
  return x ^ (x >> 32U);
}

}  // namespace

void ContentHash::add(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(bytes);
  std::array<std::uint64_t, 4> words{};
  std::array<std::uint64_t, 4> lanes = lanes_;
  std::size_t left = count;
  for (; left >= sizeof words; left -= sizeof words, at += sizeof words) {
    std::memcpy(words.data(), at, sizeof words);
    for (std::size_t k = 0; k < 4; ++k) lanes[k] = stir(lanes[k], words[k]);
  }
  words = {};
  if (left > 0) std::memcpy(words.data(), at, left);
  words[3] ^= static_cast<std::uint64_t>(count) << 8U;  // where one run ends counts, too
  for (std::size_t k = 0; k < 4; ++k) lanes[k] = stir(lanes[k], words[k]);
  lanes_ = lanes;
  count_ += count;
}

std::array<std::uint64_t, 2> ContentHash::value() const {
  std::array<std::uint64_t, 2> out = {count_, ~count_};
  for (std::size_t k = 0; k < 4; ++k) {
    out[0] = settle(out[0] + std::rotl(lanes_[k], static_cast<int>(7 * k)));
    out[1] = settle(out[1] ^ (lanes_[k] * (2 * k + 3)));
  }
  return out;
}

std::string ContentHash::text() const {
  const auto [first, second] = value();
  return fmt::format("{:016x}{:016x}", first, second);
}

}  // namespace buckens::linalg
