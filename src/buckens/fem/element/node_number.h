// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

namespace buckens::fem {

/// The number in a mesh-file node name, "n17"; empty for other names.
inline std::optional<std::int64_t> node_number(const std::string& name) {
  std::int64_t number = 0;
  const char* end = name.data() + name.size();
  if (name.size() < 2 || name[0] != 'n') return std::nullopt;
  const auto [rest, error] = std::from_chars(name.data() + 1, end, number);
  if (error != std::errc() || rest != end || number < 0) return std::nullopt;
  return number;
}

}  // namespace buckens::fem
