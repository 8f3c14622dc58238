// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace buckens::linalg {

/// A supernodal Cholesky factor P A Pᵀ = L Lᵀ as stored by its owner: views, valid as long as that
/// lives. Supernodes are runs of columns with the same rows below; children come before parents.
struct Supernodes {
  int size = 0;                              ///< n
  int count = 0;                             ///< of supernodes
  const int* permutation = nullptr;          ///< row k of P A Pᵀ is row permutation[k] of A
  const int* first_column = nullptr;         ///< count + 1
  const std::int64_t* rows_begin = nullptr;  ///< count + 1: supernode s has rows[rows_begin[s]] …
  const std::int64_t* values_begin = nullptr;  ///< count
  const int* rows = nullptr;                   ///< ascending, own columns first
  const double* values = nullptr;              ///< rows × columns per supernode, column by column
  bool used_up = false;                        ///< values are read once and not needed afterwards

  int columns(int s) const { return first_column[s + 1] - first_column[s]; }
  int num_rows(int s) const { return static_cast<int>(rows_begin[s + 1] - rows_begin[s]); }
};

}  // namespace buckens::linalg
