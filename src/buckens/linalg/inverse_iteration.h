// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::linalg {

/// F ← A⁻¹F, column by column, optionally followed by a projection; symmetric in the sense that
/// xᵀM A⁻¹M y = yᵀM A⁻¹M x.
using InverseOperator = std::function<void(Matrix&)>;

/// M X.
using MassProduct = std::function<Matrix(const Matrix&)>;

struct InverseIterationSettings {
  int count = 10;  ///< eigenpairs wanted
  int block = 6;   ///< vectors iterated at the same time
  /// Of ‖A⁻¹M x − θ x‖_M / |θ|: error of the vector; the error of θ is about its square.
  double tolerance = 1e-9;
  int max_sweeps = 400;
  /// Called after 2, 4, 8, 16 and 32 sweeps with the largest |θ| so far; `false` ends the iteration
  /// there.
  std::function<bool(double)> is_worthwhile = {};
  TaskPool* pool = nullptr;  ///< may share the products with M and the basis; changes no bit
};

/// Eigenpairs of A⁻¹M, largest |θ| first.
struct InversePairs {
  Vector theta;
  Matrix shapes;    ///< n×count, M-orthonormal
  Vector residual;  ///< ‖A⁻¹M x − θ x‖_M / |θ| from the subspace
  int sweeps = 0;
  long solves = 0;          ///< columns passed through A⁻¹
  double rounding = 0;      ///< relative asymmetry found in A⁻¹M: no residual can be smaller
  bool is_complete = true;  ///< all wanted pairs converged, and none was missed
};

/// Simultaneous inverse iteration with projection onto the subspace of all sweeps.
///
/// Each sweep maps a block X to A⁻¹M X and solves the eigenproblem in the span of all blocks so
/// far (Rayleigh–Ritz); new blocks are M-orthogonalised against all earlier ones, twice. When the
/// basis is full it restarts with the best Ritz vectors without losing progress (thick restart).
/// Compared with an iteration that discards earlier sweeps, the number of solves falls from one per
/// vector and power of θ_k/θ_j to about its square root.
///
/// Multiple eigenvalues: a block of b finds b equal ones. Afterwards a fresh block, orthogonal to
/// what was found, is iterated until it cannot contain any of the wanted pairs; new ones are added
/// and the search continues. So any multiplicity is found completely.
///
/// M may be singular (massless variables): all vectors lie in the range of A⁻¹M.
/// @param M symmetric, positive semidefinite, n×n
/// @param deflated M-orthonormal vectors to stay orthogonal to, n×k, k ≥ 0
/// @return fewer pairs than wanted where there are no more
InversePairs largest_inverse_pairs(const SparseMatrix& M, const InverseOperator& inverse,
                                   const Matrix& deflated,
                                   const InverseIterationSettings& settings);
InversePairs largest_inverse_pairs(const SymmetricMatrix& M, const InverseOperator& inverse,
                                   const Matrix& deflated,
                                   const InverseIterationSettings& settings);
/// The same of a mass matrix that need not exist as a whole.
InversePairs largest_inverse_pairs(const MassProduct& mass_times, const InverseOperator& inverse,
                                   const Matrix& deflated,
                                   const InverseIterationSettings& settings);

/// n×columns numbers in (−1, 1), the same on every call.
Matrix scattered_block(Eigen::Index rows, Eigen::Index columns, unsigned seed);

}  // namespace buckens::linalg
