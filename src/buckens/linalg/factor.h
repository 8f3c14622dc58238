// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/divided_vector.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

struct DividedPencil;
struct InversePairs;

/// Work of a solver that iterates.
struct IterationCounts {
  long solves = 0, iterations = 0;
  double seconds = 0;        ///< of all solves, wall time [s]
  double setup_seconds = 0;  ///< before the first one [s]
};

/// Factor of a symmetric positive definite matrix A: computed once, used for many solves.
///
/// All that code which solves needs to know. SparseCholesky keeps the factor in the memory of this
/// process; IterativeSolver has none and iterates; another implementation may keep it on an
/// accelerator or distribute it.
class Factor {
 public:
  virtual ~Factor() = default;

  virtual Eigen::Index size() const = 0;
  /// Entries of L.
  virtual double num_factor_entries() const = 0;
  /// Bytes that each of the two passes of a solve reads.
  virtual double bytes() const = 0;

  /// X ← A⁻¹ B for contiguous columns; X may be B.
  /// @param pool may share the work; the result must not depend on it
  virtual void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const = 0;
  /// x ← A⁻¹ x for vectors of length size() anywhere in memory.
  virtual void solve_in_place(std::span<double* const> vectors, TaskPool* pool = nullptr) const = 0;

  /// Whether answers are found by iteration: then an estimate of the answer spares work.
  virtual bool iterates() const { return false; }
  /// x ← A⁻¹ b. @param x on entry an estimate of the answer, used by solvers that iterate
  /// @param energy √(yᵀA y) of a vector y beside which the error of x has to be negligible; 0: x
  virtual void improve(const Vector& b, Vector& x, double energy) const;
  /// Nothing but zeros of a factor that does not iterate.
  virtual IterationCounts iteration_counts() const { return {}; }

  /// Whether it answers vectors that other processes have.
  virtual bool solves_divided() const { return false; }
  /// In which order the others have rows of A, if it is divided among them.
  virtual SharedRowOrder row_order() const { return nullptr; }
  /// A⁻¹ b of such a vector. @pre solves_divided()
  virtual DividedVector solve_divided(DividedVectors& /*vectors*/,
                                      const DividedVector& /*b*/) const {
    return {};
  }

  /// Whether processes find eigenpairs by it among themselves, shared_modes.h. Then they are in
  /// `pairs`.
  virtual bool find_pairs(const DividedPencil& /*of*/, InversePairs& /*pairs*/) const {
    return false;
  }

  /// x ← A⁻¹ x. Cost: two passes over the factor.
  void solve_in_place(Vector& x, TaskPool* pool = nullptr) const {
    solve(x.data(), x.data(), 1, pool);
  }
  /// X ← A⁻¹ X for several right-hand sides at once.
  void solve_in_place(Matrix& X, TaskPool* pool = nullptr) const {
    solve(X.data(), X.data(), X.cols(), pool);
  }
  /// A⁻¹ B.
  Matrix solve(const Matrix& B, TaskPool* pool = nullptr) const {
    Matrix X(B.rows(), B.cols());
    solve(B.data(), X.data(), B.cols(), pool);
    return X;
  }
};

inline void Factor::improve(const Vector& b, Vector& x, double /*energy*/) const {
  x = b;
  solve_in_place(x);
}

class MatrixSum;

/// Function that factorises A, of which it keeps nothing.
/// @throws NumericalError if A is not positive definite
using MakeFactor = std::function<std::shared_ptr<const Factor>(const MatrixSum& A)>;

}  // namespace buckens::linalg
