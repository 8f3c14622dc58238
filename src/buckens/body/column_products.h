// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace buckens::body {

/// Products of two columns of a dense matrix with several vectors at once, and their contribution
/// to a product with the matrix: each number of the matrix is read once.
///
/// Written with vectors of four, which the compiler maps to the processor's instructions; sums of
/// four lanes, always added in the same order.
template <int Dots>
struct ColumnPair {
  std::array<double, Dots> first{}, second{};  ///< c0ᵀ x_k, c1ᵀ x_k

  /// @param c0,c1 the columns, n numbers each, @param x Dots vectors
  /// @param y if not null, y += c0 spread[0] + c1 spread[1]
  void multiply(const double* c0, const double* c1, int n, const std::array<const double*, Dots>& x,
                const std::array<double, 2>& spread, double* y) {
    Four a[Dots] = {}, b[Dots] = {};
    const Four s = {spread[0], spread[0], spread[0], spread[0]};
    const Four t = {spread[1], spread[1], spread[1], spread[1]};
    int i = 0;
    for (; i + 4 <= n; i += 4) {
      Four u, v;
      load(c0 + i, u);
      load(c1 + i, v);
      for (int k = 0; k < Dots; ++k) {
        Four z;
        load(x[static_cast<std::size_t>(k)] + i, z);
        a[k] += u * z;
        b[k] += v * z;
      }
      if (y == nullptr) continue;
      Four sum;
      load(y + i, sum);
      sum += u * s + v * t;
      __builtin_memcpy(y + i, &sum, sizeof sum);
    }
    for (int k = 0; k < Dots; ++k) {
      first[static_cast<std::size_t>(k)] = (a[k][0] + a[k][1]) + (a[k][2] + a[k][3]);
      second[static_cast<std::size_t>(k)] = (b[k][0] + b[k][1]) + (b[k][2] + b[k][3]);
    }
    for (; i < n; ++i) {
      for (std::size_t k = 0; k < Dots; ++k) {
        first[k] += c0[i] * x[k][i];
        second[k] += c1[i] * x[k][i];
      }
      if (y != nullptr) y[i] += c0[i] * spread[0] + c1[i] * spread[1];
    }
  }

 private:
  typedef double Four __attribute__((vector_size(32)));

  // By reference: the calling convention for a vector of four by value differs with and without
  // AVX.
  static void load(const double* p, Four& out) { __builtin_memcpy(&out, p, sizeof out); }
};

}  // namespace buckens::body
