// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <climits>
#include <memory>
#include <span>

#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/factor.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/simd_level.h"

namespace buckens::linalg {

/// What factorises, and does the forward and backward substitution.
enum class SolveRoute {
  automatic,  ///< the fastest: panels
  panels,     ///< PanelFactor, factorised in place (multifrontal.h)
  cholmod,    ///< CHOLMOD's own: the reference for tests and benchmarks
};

struct CholeskyOptions {
  SolveRoute route = SolveRoute::automatic;
  SimdLevel simd = best_simd_level();  ///< of the panels
  /// Largest number of entries of a factor with 32-bit indices; above it CHOLMOD uses 64 bits.
  double most_narrow_entries = INT_MAX;
};

/// Cholesky factor of a sparse symmetric positive definite matrix: factorised once, used for many
/// solves.
///
/// The factor is made in the layout it is solved from (PanelFactor), in the order of METIS' nested
/// dissection (small ones: AMD's least degree), by the threads that base::AllowedThreads allows.
/// Solving allocates nothing after the first call of a given number of right-hand sides. Solves
/// from several threads wait for one another.
class SparseCholesky final : public Factor {
 public:
  /// @param A symmetric, both triangles stored
  /// @throws IndefiniteMatrix if A is not positive definite
  /// @throws NumericalError if A is not finite or its factor does not fit into memory
  explicit SparseCholesky(const SparseMatrix& A, const CholeskyOptions& options = {});
  /// The same of a sum, which never exists as a whole: 1 kB per variable of solids less. The same
  /// bits.
  explicit SparseCholesky(const MatrixSum& A);
  ~SparseCholesky() override;
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  Eigen::Index size() const override;
  double num_factor_entries() const override;
  double bytes() const override;
  /// Parts of a solve that threads can carry out at the same time; more threads are of no use.
  int num_parts() const;
  /// Share of bytes() that the busiest of several threads reads in each pass.
  double busiest_share(int threads) const;
  /// Never `automatic`.
  SolveRoute route() const;
  /// Width of the indices of the factor: 64; of CHOLMOD's own what it needed, 32 or 64.
  int index_bits() const;
  /// Copies CHOLMOD's own into panels, a reference for theirs. Not while other threads solve.
  /// @return false if the factor has no dense parts; then nothing changes
  bool take_panels(SimdLevel simd = best_simd_level());

  using Factor::solve;
  using Factor::solve_in_place;
  /// Up to 32 columns share one read of the factor.
  /// @param pool shares the work of large factors between two threads; the result is the same
  void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const override;
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool = nullptr) const override;

 private:
  struct Backend;
  std::unique_ptr<Backend> backend_;
};

/// The MakeFactor of this library: a SparseCholesky with default options.
std::shared_ptr<const Factor> make_cholesky(const MatrixSum& A);

}  // namespace buckens::linalg
