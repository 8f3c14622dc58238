// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/linalg/factor.h"
#include "buckens/linalg/grid_plugin.h"
#include "buckens/linalg/matrix_sum.h"

namespace buckens::linalg {

struct IterationSettings {
  int block = 1;             ///< variables per node if all nodes have as many, node by node; else 1
  double tolerance = 1e-11;  ///< of an answer, in the norm of energy
  int most_iterations = 500;
  std::string options;  ///< of PETSc, such as "-mg_levels_ksp_max_it 3"
};

/// Solves A x = b by conjugate gradients with smoothed-aggregation multigrid (grid_library.h)
/// instead of a factor: memory and time of a solve grow like the size of A.
///
/// The error e of an answer x satisfies √(eᵀA e) ≤ tolerance·√(xᵀA x), as the preconditioner
/// estimates it, and is below 1e-8 of what the estimate of the answer lacked: in a step, that
/// is about its local error. Always the same bits, whatever the number of threads.
class IterativeSolver final : public Factor {
 public:
  /// @param A symmetric positive definite, both triangles stored; kept if this process works alone
  /// @param motions n×(0…6), motions with little energy: those of a rigid body
  /// @throws IoError if there is no multigrid solver
  /// @throws NumericalError if A is not finite, or it cannot be made, as with unknown options
  IterativeSolver(SparseMatrix A, const Matrix& motions, const IterationSettings& settings);
  /// The same of a sum, which is formed whole only if this process works alone.
  IterativeSolver(const MatrixSum& A, const Matrix& motions, const IterationSettings& settings);
  ~IterativeSolver() override;
  IterativeSolver(const IterativeSolver&) = delete;
  IterativeSolver& operator=(const IterativeSolver&) = delete;

  Eigen::Index size() const override { return size_; }
  /// Entries of A and of the coarser matrices, about.
  double num_factor_entries() const override;
  double bytes() const override;

  using Factor::solve;
  using Factor::solve_in_place;
  /// One column after the other, from zero. @throws NumericalError if one does not converge
  void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const override;
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool) const override;

  bool iterates() const override { return true; }
  void improve(const Vector& b, Vector& x, double energy) const override;
  IterationCounts iteration_counts() const override;

 private:
  void make(BuckensGridMatrix matrix, const Matrix& motions);
  /// Takes A over, which is empty afterwards.
  void keep(SparseMatrix& A, const Matrix& motions);
  void share(const MatrixSum& A, const Matrix& motions);
  void iterate(const double* b, double* x, double energy) const;

  Eigen::Index size_;
  SparseMatrix A_;      // empty where several processes hold its rows
  double entries_ = 0;  // of A
  IterationSettings settings_;
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace buckens::linalg
