// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "buckens/linalg/elimination_order.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/supernodes.h"

namespace buckens::linalg {

/// Structure of a Cholesky factor P A Pᵀ = L Lᵀ, before it is computed.
///
/// SupernodeTree are runs of columns with the same rows below; their parents are the supernodes to
/// which the first of these rows belong. Numbered so that every subtree is a run that ends with its
/// root.
struct SupernodeTree {
  int size = 0;                          ///< n
  int count = 0;                         ///< of supernodes
  std::vector<int> permutation;          ///< row k of P A Pᵀ is row permutation[k] of A
  std::vector<int> first_column;         ///< count + 1
  std::vector<int> parent;               ///< −1 for roots
  std::vector<std::int64_t> rows_begin;  ///< count + 1: supernode s has rows[rows_begin[s]] …
  std::vector<int> rows;                 ///< ascending, below its own columns
  double num_entries = 0;                ///< of L, without zeros that supernodes store
  double num_products = 0;  ///< Σ (entries of a column)², about the work to compute it

  int columns(int s) const { return at(first_column, s + 1) - at(first_column, s); }
  int rows_below(int s) const {
    return static_cast<int>(at(rows_begin, s + 1) - at(rows_begin, s));
  }
  const int* rows_of(int s) const { return rows.data() + at(rows_begin, s); }

 private:
  template <class T>
  static T at(const std::vector<T>& values, int k) {
    return values[static_cast<std::size_t>(k)];
  }
};

/// Orders the columns of A, and finds the supernodes of its factor: fundamental ones, joined where
/// that stores few zeros (Ashcraft and Grimes 1989).
/// @param A symmetric, both triangles stored; the values are not read
SupernodeTree find_supernode_tree(const SparseMatrix& A);
SupernodeTree find_supernode_tree(const MatrixSum& A);
SupernodeTree find_supernode_tree(const ColumnGraph& graph);

/// The structure of a factor that CHOLMOD has computed.
SupernodeTree supernode_tree(const Supernodes& source);

}  // namespace buckens::linalg
