// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::body {

/// Removes rigid-body motion from the nodal variables of one flexible body.
///
/// The Buckens frame demands Pᵀd = 0 with P = MΦ, FM (25), (26). Adding a rigid motion to d changes
/// no strain, so the condition is met by the projection
///
///     Y d = d − Φ S⁻¹ (Pᵀ d),   S = ΦᵀMΦ                                FM (38), (39)
///
/// instead of the multiplier term PΛ. Loads are sieved by Yᵀ. Y is idempotent and self-adjoint in
/// the M-product; it is full, so it is never formed: 24 n flops per application.
///
/// S is handled by its rank: Φ is replaced by an M-orthonormal basis of the motions that carry
/// mass, so that S becomes the identity.
class Sieve {
 public:
  /// @param Phi rigid modes, n×6, zero columns allowed
  /// @param M mass matrix, n×n
  Sieve(const linalg::Matrix& Phi, const linalg::SymmetricMatrix& M);

  /// d ← Y d.
  void apply(linalg::Vector& d) const;
  /// Sieves each column.
  void apply(linalg::Matrix& columns) const;
  /// f ← Yᵀ f for loads.
  void apply_transposed(linalg::Vector& f) const;

  /// Rigid motion left in d: S⁻¹Pᵀd, three translations [m] and three rotations [rad].
  Eigen::Matrix<double, 6, 1> rigid_part(const linalg::Vector& d) const;

  /// Number of rigid motions with mass, at most six.
  Eigen::Index rank() const { return Phi_.cols(); }
  const Eigen::Matrix<double, 6, 6>& S() const { return S_; }
  /// M-orthonormal rigid modes and their images P = MΦ, n×rank.
  const linalg::Matrix& Phi() const { return Phi_; }
  const linalg::Matrix& P() const { return P_; }

 private:
  Eigen::Matrix<double, 6, 6> S_;
  linalg::Matrix to_axes_;  // 6×rank: amplitudes of the orthonormal modes → translations, rotations
  linalg::Matrix Phi_, P_;
};

}  // namespace buckens::body
