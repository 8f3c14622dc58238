// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <climits>
#include <memory>
#include <span>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/simd_level.h"

namespace buckens::linalg {

/// Who carries out the forward and backward substitution.
enum class SolveRoute {
  automatic,  ///< panels where the factor has dense parts worth it, otherwise CHOLMOD
  panels,     ///< PanelFactor, whatever the matrix
  cholmod,    ///< CHOLMOD's own: the reference of tests and benchmarks
};

struct CholeskyOptions {
  SolveRoute route = SolveRoute::automatic;
  SimdLevel simd = best_simd_level();  ///< of the panels
  /// Entries of a factor that 32-bit indices are taken to reach; beyond, CHOLMOD counts in 64 bits.
  double most_narrow_entries = INT_MAX;
};

/// Cholesky factor of a sparse symmetric positive definite matrix: factorised once, solved often.
///
/// CHOLMOD factorises; the ordering is METIS' or nested dissection, whichever fills less. Large
/// factors are then laid out anew for solving (PanelFactor) and CHOLMOD's copy is freed.
/// Solving allocates nothing after the first call of a given number of right-hand sides. Solves
/// from several threads wait for one another.
class SparseCholesky {
 public:
  /// @param A symmetric, both triangles stored
  /// @throws IndefiniteMatrix if A is not positive definite
  /// @throws NumericalError if A is not finite or its factor does not fit into memory
  explicit SparseCholesky(const SparseMatrix& A, const CholeskyOptions& options = {});
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  Eigen::Index size() const;
  /// Entries of L.
  double num_factor_entries() const;
  /// Bytes that each of the two passes of a solve reads.
  double bytes() const;
  /// Parts of a solve that two threads can carry out at the same time: 1 or 2.
  int num_parts() const;
  /// Never `automatic`.
  SolveRoute route() const;
  /// Width of CHOLMOD's indices that the factor needed: 32 or 64.
  int index_bits() const;
  /// Solves over panels from now on; CHOLMOD's copy is freed. Not while others solve.
  /// @return false if the factor has no dense parts to lay out; then nothing changes
  bool take_panels(SimdLevel simd = best_simd_level());

  /// x ← A⁻¹ x. Cost: two passes over the factor.
  /// @param pool shares the work of large factors between two threads; the result is the same
  void solve_in_place(Vector& x, TaskPool* pool = nullptr) const;
  /// X ← A⁻¹ X for several right-hand sides at once: up to 32 read the factor together.
  void solve_in_place(Matrix& X, TaskPool* pool = nullptr) const;
  /// The same for vectors that lie anywhere.
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool = nullptr) const;
  /// A⁻¹ B.
  Matrix solve(const Matrix& B, TaskPool* pool = nullptr) const;

 private:
  struct Backend;
  std::unique_ptr<Backend> backend_;
};

}  // namespace buckens::linalg
