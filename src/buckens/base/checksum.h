// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace buckens::base {

/// 64-bit FNV-1a of these bytes: finds damage and tells contents apart; no protection against
/// intent. Source: Fowler, Noll, Vo, draft-eastlake-fnv. Cost: one multiplication per byte.
/// @param hash of what comes before, if the bytes are the next of several pieces
constexpr std::uint64_t checksum(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

}  // namespace buckens::base
