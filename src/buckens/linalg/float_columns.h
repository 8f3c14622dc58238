// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace buckens::linalg {

/// Some columns in single precision. All arithmetic with them is in double precision.
struct FloatColumns {
  const float* values = nullptr;
  std::ptrdiff_t stride = 0;  ///< from column to column
  std::ptrdiff_t rows = 0;
  int count = 0;

  /// out[i] ← columnᵢᵀ x
  void products(const double* x, double* out) const;
  /// y ← y + Σ factor weightᵢ columnᵢ
  void add_to(double factor, const double* weights, double* y) const;
};

}  // namespace buckens::linalg
