// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "buckens/linalg/content_hash.h"

namespace buckens::linalg {

/// Adds a number for a column of a symmetric matrix, from the diagonal on, to the one that stands
/// for the content of the matrix. It is a sum over columns: several processes may have them.
inline void add_content(int column, std::span<const int> rows, std::span<const double> values,
                        std::array<std::uint64_t, 2>& sum) {
  ContentHash hash;
  hash.add(static_cast<std::uint64_t>(column));
  hash.add(rows.data(), rows.size_bytes());
  hash.add(values.data(), values.size_bytes());
  const auto number = hash.value();
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += number[k];
}

}  // namespace buckens::linalg
