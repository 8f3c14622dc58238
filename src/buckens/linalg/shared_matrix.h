// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A constant sparse matrix that several read, or none; copies are the same matrix.
///
/// One that can be made again need not stay: let_go() frees its memory, and the next who reads it
/// waits until it is there again.
class SharedMatrix {
 public:
  using Make = std::function<SparseMatrix()>;

  SharedMatrix() = default;
  /// Takes the content over. Eigen's own move operations copy sparse matrices.
  /// @param again makes the same matrix, as often as it is let go of; empty: it stays
  explicit SharedMatrix(SparseMatrix&& A, Make again = {});

  explicit operator bool() const { return held_ != nullptr; }
  /// Also of one that is not here.
  Eigen::Index rows() const;
  Eigen::Index nonZeros() const;

  /// The reference ends with let_go().
  const SparseMatrix& operator*() const;
  const SparseMatrix* operator->() const { return &**this; }
  const SparseMatrix* get() const { return held_ ? &**this : nullptr; }
  /// The matrix itself. @pre nobody lets go of it
  std::shared_ptr<const SparseMatrix> pointer() const { return {held_, get()}; }

  bool is_here() const;
  /// Nothing of one that cannot be made again. @pre nobody reads it now
  void let_go() const;
  /// Whether they have the same bits; of matrices that are not here their content is compared.
  bool has_same_bits(const SharedMatrix& other) const;

 private:
  struct Held;
  std::shared_ptr<Held> held_;
};

}  // namespace buckens::linalg
