// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <climits>
#include <memory>
#include <string>

#include "buckens/base/errors.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/supernodes.h"

namespace buckens::linalg {

/// A factorisation found a pivot that is not positive.
class IndefiniteMatrix : public NumericalError {
 public:
  IndefiniteMatrix(Eigen::Index size, Eigen::Index column);
  /// Where the column is not known.
  explicit IndefiniteMatrix(const std::string& text) : NumericalError(text) {}
  /// Row of the original matrix whose pivot is not positive; −1 if it is not known.
  Eigen::Index column() const { return column_; }

 private:
  Eigen::Index column_ = -1;
};

/// L Lᵀ = P A Pᵀ by CHOLMOD, with 32-bit indices where they can address every entry of L, otherwise
/// with 64-bit ones.
class CholmodFactor {
 public:
  struct Options {
    bool supernodal = false;       ///< always; otherwise where L is dense enough for it
    double most_narrow = INT_MAX;  ///< entries of L: up to this, 32-bit indices
  };
  /// Analyses and factorises, in one thread.
  /// @param A symmetric, both triangles stored
  /// @throws IndefiniteMatrix if A is not positive definite
  /// @throws NumericalError if entries are not finite, memory runs out, or A is too large even for
  /// 64-bit indices, saying which and how large
  static std::unique_ptr<CholmodFactor> make(const SparseMatrix& A, const Options& options);

  virtual ~CholmodFactor() = default;
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// x ← A⁻¹ b, column by column. @param b,x rows × columns, may be the same
  virtual void solve(const double* b, double* x, Eigen::Index rows, Eigen::Index columns) = 0;
  virtual bool is_supernodal() const = 0;
  /// Contents of a supernodal factor, valid as long as it lives.
  virtual Supernodes supernodes() = 0;
  /// Entries of L.
  virtual double num_entries() const = 0;
  /// Bytes that a pass over L reads.
  virtual double bytes() const = 0;
  virtual int index_bits() const = 0;

 protected:
  CholmodFactor() = default;
};

}  // namespace buckens::linalg
