// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace buckens::linalg {

/// Adds a number for an entry of a symmetric matrix, on the diagonal or of one triangle, to the one
/// that stands for the content of the matrix. It is a sum over entries: several processes may have
/// them, in any order. Tells accidents apart, not attacks.
inline void add_content(int row, int column, double value, std::array<std::uint64_t, 2>& sum) {
  // The last step of SplitMix64.
  const auto mixed = [](std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  };
  const auto low = static_cast<std::uint64_t>(std::min(row, column));
  const auto high = static_cast<std::uint64_t>(std::max(row, column));
  const std::uint64_t place = mixed((high << 32U | low) + 0x9e3779b97f4a7c15U);
  const auto bits = std::bit_cast<std::uint64_t>(value);
  sum[0] += mixed(place + bits);
  sum[1] += mixed((place ^ 0x243f6a8885a308d3U) + (bits << 32U | bits >> 32U));
}

/// Of both triangles of a sparse matrix the lower one counts, as of a divided matrix.
template <class Sparse>
std::array<std::uint64_t, 2> symmetric_content(const Sparse& A) {
  std::array<std::uint64_t, 2> sum{};
  for (int column = 0; column < A.cols(); ++column) {
    for (typename Sparse::InnerIterator it(A, column); it; ++it) {
      if (it.row() >= column) add_content(static_cast<int>(it.row()), column, it.value(), sum);
    }
  }
  return sum;
}

}  // namespace buckens::linalg
