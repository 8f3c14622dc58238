// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "buckens/base/task_pool.h"
#include "buckens/body/sieve.h"
#include "buckens/linalg/inverse_iteration.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::body {

/// A factored matrix A whose inverse, applied to M d, has the elastic modes of a free body as
/// eigenvectors with the largest eigenvalues 1/(ω² + shift).
struct ModeOperator {
  linalg::InverseOperator inverse;  ///< F ← the elastic part of A⁻¹F, without rigid motion
  double shift = 0;                 ///< μ [1/s²]
  double penalty = 0;               ///< c [1/s²]
  double factor_entries = 0;
  /// A itself and its inverse, for estimating its condition number; size of A.
  std::function<linalg::Vector(const linalg::Vector&)> multiply, solve;
  linalg::Vector scale;  ///< scales the diagonal of A to one
  /// For what is done with large vectors, as long as base::AllowedThreads allows it; null: none.
  TaskPool* pool = nullptr;
};

/// K + μM. @param K,M outlive it
linalg::MatrixSum shifted(const linalg::SymmetricMatrix& K, double shift,
                          const linalg::SymmetricMatrix& M);

/// Y (K + μM)⁻¹Yᵀ, FM (30), (31): one sparse Cholesky factor, or what `make` makes in its place.
/// @param M,K outlive what is returned
/// @throws NumericalError if μ is lost in the rounding of K
ModeOperator sieved_operator(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K,
                             const Sieve& sieve, double shift,
                             const linalg::MakeFactor& make = linalg::make_cholesky);

/// The upper left part of [K −P; −Pᵀ 0]⁻¹, FM (28): a sparse LU factor of an indefinite matrix with
/// full rows and columns. No shift is needed: the bordered matrix is regular.
/// @throws ModelError if the factor would not fit into memory
ModeOperator augmented_operator(const linalg::SymmetricMatrix& K, const Sieve& sieve);

/// (K + c PPᵀ)⁻¹ with P = MΦ of M-orthonormal rigid motions, FM (29): these become modes with
/// ω² = c.
///
/// Up to 1500 variables the full matrix is formed and factorised literally: n²/2 entries
/// and n³/6 multiplications. Above, the same inverse comes from the factor of K + μM with a
/// rank-six correction (Woodbury), then with the shift μ.
/// @param M,K outlive what is returned
ModeOperator penalty_operator(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K,
                              const Sieve& sieve, double penalty, double shift,
                              const linalg::MakeFactor& make = linalg::make_cholesky);

/// λ_max/λ_min of the scaled matrix A by twenty power iterations each.
double estimate_condition(const ModeOperator& op);

}  // namespace buckens::body
